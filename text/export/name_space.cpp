// SPDX-License-Identifier: Apache-2.0
#include "text/export/name_space.hpp"

#include <algorithm>
#include <iterator>

namespace text {
namespace {

/// Keywords of C++20, its alternative operators, names that the header uses, and macros of GNU compilers.
constexpr std::string_view taken_names[] = {
    "alignas",     "alignof",  "and",        "and_eq",    "asm",       "auto",         "bitand",
    "bitor",       "bool",     "break",      "case",      "catch",     "char",         "char16_t",
    "char32_t",    "char8_t",  "class",      "co_await",  "co_return", "co_yield",     "compl",
    "concept",     "const",    "const_cast", "consteval", "constexpr", "constinit",    "continue",
    "decltype",    "default",  "delete",     "do",        "double",    "dynamic_cast", "else",
    "enum",        "explicit", "export",     "extern",    "false",     "float",        "for",
    "friend",      "goto",     "if",         "inline",    "int",       "long",         "mutable",
    "namespace",   "new",      "noexcept",   "not",       "not_eq",    "nullptr",      "operator",
    "or",          "or_eq",    "private",    "protected", "public",    "register",     "reinterpret_cast",
    "requires",    "return",   "short",      "signed",    "sizeof",    "static",       "static_assert",
    "static_cast", "struct",   "switch",     "template",  "this",      "thread_local", "throw",
    "true",        "try",      "typedef",    "typeid",    "typename",  "union",        "unsigned",
    "using",       "virtual",  "void",       "volatile",  "wchar_t",   "while",        "xor",
    "xor_eq",      "std",      "sixstep",    "main",      "linux",     "unix"};

bool is_letter(char x) { return (x >= 'a' && x <= 'z') || (x >= 'A' && x <= 'Z') || x == '_'; }

bool is_digit(char x) { return x >= '0' && x <= '9'; }

bool is_free_name(std::string_view name) {
  if (name.empty() || !is_letter(name[0])) return false;
  if (!std::all_of(name.begin(), name.end(), [](char x) { return is_letter(x) || is_digit(x); }))
    return false;
  // Names reserved for compilers and libraries.
  const bool reserved = name.find("__") != std::string_view::npos ||
                        (name.size() > 1 && name[0] == '_' && name[1] >= 'A' && name[1] <= 'Z');
  return !reserved &&
         std::find(std::begin(taken_names), std::end(taken_names), name) == std::end(taken_names);
}

}  // namespace

bool is_name_space(std::string_view text) {
  for (std::size_t cut = text.find("::"); cut != std::string_view::npos; cut = text.find("::")) {
    if (!is_free_name(text.substr(0, cut))) return false;
    text.remove_prefix(cut + 2);
  }
  return is_free_name(text);
}

}  // namespace text

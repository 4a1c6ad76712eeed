// SPDX-License-Identifier: Apache-2.0
#include "text/toml/syntax_cure.hpp"

#include <array>

namespace text {
namespace {

struct Cure {
  std::string_view met;  ///< part of the parser's message
  std::string_view cure;
};

/// The cures in order; the first cure whose `met` occurs in the message applies.
constexpr std::array<Cure, 11> syntax_cures = {{
    {"invalid utf-8", "save the file as text in UTF-8"},
    {"parsing string", "close the quote on the same line"},
    {"cannot redefine", "give each key and table once"},
    {"could not determine value type",
     "put words in quotes, as \"speed\"; numbers, true and false have no quotes"},
    {"parsing boolean", "write true or false, in small letters"},
    {"expected a comment or whitespace, saw ','", "write a decimal point, as 0.5, or a list in brackets"},
    {"expected a comment or whitespace", "end the line after the value; the key contains the unit"},
    {"expected '='", "write KEY = VALUE"},
    {"parsing table header", "close the header: [table], or [[table]] for a list of tables"},
    {"parsing array", "close the list with ]"},
    {"parsing inline table", "close the table with }"},
}};

}  // namespace

std::string_view syntax_cure(std::string_view met) {
  for (const Cure& cure : syntax_cures)
    if (met.find(cure.met) != std::string_view::npos) return cure.cure;
  return "correct the TOML syntax";
}

}  // namespace text

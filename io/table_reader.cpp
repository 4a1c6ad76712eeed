// SPDX-License-Identifier: Apache-2.0
#include "io/table_reader.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>

#include "io/key_advice.hpp"

namespace io {
namespace {

std::string in_unit(const base::About& about) {
  return about.unit.empty() ? std::string() : fmt::format(", in {}", about.unit);
}

std::string cure_of(const base::About& about) {
  if (!about.cure.empty()) return std::string(about.cure);
  return fmt::format("it means: {}{}", about.meaning, in_unit(about));
}

/// "20 ms" where seconds belong is 0.02; nothing where the text is no number or its unit no multiple of the
/// wanted.
std::optional<double> in_wanted_unit(const std::string& text, std::string_view unit) {
  char* end = nullptr;
  const double number = std::strtod(text.c_str(), &end);
  if (end == text.c_str()) return {};
  std::string_view rest(end);
  while (!rest.empty() && rest.front() == ' ') rest.remove_prefix(1);
  if (rest.empty() || rest == unit) return number;
  if (rest.substr(1) != unit) return {};
  switch (rest.front()) {
    case 'n':
      return number / 1e9;
    case 'u':
      return number / 1e6;
    case 'm':
      return number / 1e3;
    case 'k':
      return number * 1e3;
    case 'M':
      return number * 1e6;
    default:
      return {};
  }
}

}  // namespace

const toml::node* TableReader::find(std::string_view key, const base::About& about) {
  known_.emplace_back(key);
  const toml::node* node = table_.get(key);
  if (!node && about.required && !partial_)
    complaints_.missing(at(key),
                        {.limit = "is missing",
                         .cure = fmt::format("write {} = ..: {}{}", key, about.meaning, in_unit(about))});
  return node;
}

const toml::table* TableReader::find_table(std::string_view key, const base::About& about) {
  const toml::node* node = find(key, about);
  if (node && !node->is_table())
    complaints_.value(*node, at(key),
                      {.limit = "must be a table", .cure = fmt::format("write [{}]", at(key))});
  return node ? node->as_table() : nullptr;
}

const toml::array* TableReader::find_tables(std::string_view key, const base::About& about) {
  const toml::node* node = find(key, about);
  if (!node || node->is_array_of_tables()) return node ? node->as_array() : nullptr;
  if (const toml::array* array = node->as_array(); array && array->empty()) return array;
  complaints_.value(*node, at(key),
                    {.limit = "must be a list of tables", .cure = fmt::format("write [[{}]]", at(key))});
  return nullptr;
}

bool TableReader::number(const toml::node& node, const std::string& path, const base::About& about,
                         double& out) {
  if (const toml::value<std::string>* text = node.as_string()) {
    const std::optional<double> meant = in_wanted_unit(text->get(), about.unit);
    const std::string write = meant ? fmt::format("write {}", shortest(*meant)) : cure_of(about);
    complaints_.value(
        node, path,
        {.limit =
             about.unit.empty()
                 ? "must be a number without quotes"
                 : fmt::format("must be a number without quotes; the key carries its unit, {}", about.unit),
         .cure = write});
    return false;
  }
  if (!node.is_number()) {
    complaints_.value(node, path, {.limit = "must be a number", .cure = cure_of(about)});
    return false;
  }
  const double x =
      node.is_integer() ? static_cast<double>(node.as_integer()->get()) : node.as_floating_point()->get();
  if (!about.range.holds(x)) {
    const bool finite = x - x == 0.0;
    complaints_.value(
        node, path,
        {.limit = finite ? limit_of(about.range) : "must be a finite number", .cure = cure_of(about)});
    return false;
  }
  out = x;
  return true;
}

bool TableReader::word(const toml::node& node, const std::string& path, const base::About& about,
                       std::string& out) {
  if (const toml::value<std::string>* text = node.as_string()) {
    out = text->get();
    return true;
  }
  complaints_.value(node, path, {.limit = "must be text in quotes", .cure = cure_of(about)});
  return false;
}

void TableReader::value(std::string_view key, double& member, const base::About& about) {
  if (const toml::node* node = find(key, about)) number(*node, at(key), about, member);
}

void TableReader::value(std::string_view key, std::int64_t& member, const base::About& about) {
  const toml::node* node = find(key, about);
  double checked = 0.0;
  if (!node || !number(*node, at(key), about, checked)) return;
  if (const toml::value<std::int64_t>* whole = node->as_integer())
    member = whole->get();
  else
    complaints_.value(*node, at(key), {.limit = "must be a whole number", .cure = cure_of(about)});
}

void TableReader::value(std::string_view key, int& member, const base::About& about) {
  std::int64_t wide = member;
  base::About narrow = about;
  narrow.range.high = std::min(narrow.range.high, 2147483647.0);
  narrow.range.low = std::max(narrow.range.low, -2147483648.0);
  value(key, wide, narrow);
  member = static_cast<int>(wide);
}

void TableReader::value(std::string_view key, bool& member, const base::About& about) {
  const toml::node* node = find(key, about);
  if (!node) return;
  if (const toml::value<bool>* flag = node->as_boolean())
    member = flag->get();
  else
    complaints_.value(*node, at(key),
                      {.limit = "must be true or false", .cure = fmt::format("it means: {}", about.meaning)});
}

void TableReader::value(std::string_view key, std::string& member, const base::About& about) {
  if (const toml::node* node = find(key, about)) word(*node, at(key), about, member);
}

void TableReader::value(std::string_view key, std::vector<double>& member, const base::About& about) {
  const toml::node* node = find(key, about);
  if (!node) return;
  const toml::array* items = node->as_array();
  if (!items) {
    complaints_.value(*node, at(key),
                      {.limit = "must be a list of numbers", .cure = "write it in brackets: [0, 0.1]"});
    return;
  }
  member.clear();
  for (std::size_t n = 0; n < items->size(); ++n)
    number(*items->get(n), fmt::format("{}[{}]", at(key), n), about, member.emplace_back());
}

void TableReader::value(std::string_view key, std::vector<std::string>& member, const base::About& about) {
  const toml::node* node = find(key, about);
  if (!node) return;
  const toml::array* items = node->as_array();
  if (!items) {
    complaints_.value(*node, at(key),
                      {.limit = "must be a list of words", .cure = "write it in brackets: [\"a\", \"b\"]"});
    return;
  }
  member.clear();
  for (std::size_t n = 0; n < items->size(); ++n)
    word(*items->get(n), fmt::format("{}[{}]", at(key), n), about, member.emplace_back());
}

void TableReader::no_such_word(const toml::node& node, std::string_view key,
                               const std::vector<std::string>& words) {
  constexpr std::size_t read_at_a_glance = 12;
  const std::optional<std::string> written = node.value<std::string>();
  const std::string near = written ? nearest_word(*written, words) : std::string();
  complaints_.value(node, at(key),
                    {.limit = words.size() > read_at_a_glance
                                  ? fmt::format("is none of the {} words that it may be", words.size())
                                  : "must be " + quoted_alternatives(words),
                     .cure = near.empty() ? fmt::format("see: sixstep help {}", shown(at(key)))
                                          : fmt::format("did you mean \"{}\"?", near)});
}

void TableReader::refuse_unknown_keys() {
  for (const auto& [key, node] : table_) {
    if (std::find(known_.begin(), known_.end(), key.str()) != known_.end()) continue;
    base::Problem problem = unknown_key(key.str(), known_);

    complaints_.key(key, node, at(key.str()), std::move(problem));
  }
}

}  // namespace io

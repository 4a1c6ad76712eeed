// SPDX-License-Identifier: Apache-2.0
#include "text/toml/table_reader.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "sixstep/base/linear.hpp"
#include "sixstep/base/plausible.hpp"
#include "text/keys/key_advice.hpp"

namespace text {
namespace {

/// Upper limit of reported entries of one list, because each may be of a wrong kind.
constexpr std::size_t most_told_of_a_list = 5;

/// Largest number of tables of one [[key]].
constexpr std::size_t most_tables = 10'000;

std::string in_unit_words(const base::About& about) {
  return about.unit.empty() ? std::string() : fmt::format(", in {}", about.unit);
}

std::string cure_of(const base::About& about) {
  if (!about.cure.empty()) return std::string(about.cure);
  return fmt::format("it means: {}{}", about.meaning, in_unit_words(about));
}

}  // namespace

const toml::node* TableReader::find(std::string_view key, const base::About& about) {
  known_.emplace_back(key);
  const toml::node* node = table_.get(key);
  if (!node && about.required && !partial_)
    complaints_.missing(
        at(key), {.limit = "is missing",
                  .cure = fmt::format("write {} = ..: {}{}", key, about.meaning, in_unit_words(about))});
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
  if (node && node->is_array_of_tables()) {
    if (node->as_array()->size() <= most_tables) return node->as_array();
    complaints_.value(
        *node, at(key),
        {.limit = fmt::format("has {} tables; at most {} are allowed", node->as_array()->size(), most_tables),
         .cure = "remove some tables; write a long reference as a file, with shape = \"csv\""});
    return nullptr;
  }
  if (!node) return nullptr;
  if (const toml::array* array = node->as_array(); array && array->empty()) return array;
  complaints_.value(*node, at(key),
                    {.limit = "must be a list of tables", .cure = fmt::format("write [[{}]]", at(key))});
  return nullptr;
}

double TableReader::within(const base::About& about) {
  const base::Range range = base::allowed(about);
  for (const double plain : {0.0, 1.0})
    if (range.holds(plain)) return plain;
  return range.high_included ? range.high : range.low;
}

bool TableReader::number(const toml::node& node, const std::string& path, const base::About& about,
                         double& out) {
  const base::Result<double> x = number_of(node, about);
  const auto refuse = [&](base::Problem problem) {
    refused_ = true;
    if (lost_word_ && !about.unit_here.empty() && node.is_string()) return false;
    if (problem.cure.empty()) problem.cure = cure_of(about);
    complaints_.value(node, path, std::move(problem));
    return false;
  };
  if (!x) return refuse(x.problems().at(0));
  if (const base::Range range = base::allowed(about); !range.holds(*x)) {
    const bool finite = *x - *x == 0.0;
    return refuse({.limit = finite ? limit_as_written(node, about, *x) : "must be a finite number"});
  }
  out = *x;
  return true;
}

bool TableReader::word(const toml::node& node, const std::string& path, const base::About& about,
                       std::string& out) {
  if (const toml::value<std::string>* text = node.as_string()) {
    out = text->get();
    return true;
  }
  std::string cure = cure_of(about);
  if (node.is_number() || node.is_boolean())
    cure = "write " + complaints_.document().written_as_text(node, path) + "; " + cure;
  complaints_.value(node, path, {.limit = "must be text in quotes", .cure = std::move(cure)});
  return false;
}

namespace {

/// The key in another spelling: its unit, and bounds in that unit.
base::About in_spelling(base::About about, const base::Spelling& spelling) {
  if (!spelling.unit.empty()) about.unit = spelling.unit;
  for (double* end : {&about.range.low, &about.range.high})
    if (*end - *end == 0.0) *end = base::as_spelled(*end, spelling);
  about.also = {};
  return about;
}

}  // namespace

void TableReader::read(std::string_view key, double& member, const base::About& about) {
  const std::optional<base::Spelling> spelling =
      about.also.empty() ? std::nullopt : spelling_in_file(key, about);
  if (!spelling || spelling->key == key) {
    if (const toml::node* node = find(key, about)) number(*node, at(key), about, member);
    return;
  }
  double written = 0.0;
  if (number(*table_.get(spelling->key), at(spelling->key), in_spelling(about, *spelling), written))
    member = base::in_own_unit(written, *spelling);
}

void TableReader::read(std::string_view key, std::int64_t& member, const base::About& about) {
  const toml::node* node = find(key, about);
  double checked = 0.0;
  if (!node || !number(*node, at(key), about, checked)) return;
  if (const toml::value<std::int64_t>* whole = node->as_integer())
    member = whole->get();
  else
    complaints_.value(*node, at(key), {.limit = "must be a whole number", .cure = cure_of(about)});
}

void TableReader::read(std::string_view key, int& member, const base::About& about) {
  std::int64_t wide = member;
  base::About narrow = about;
  narrow.range.high = std::min(narrow.range.high, 2147483647.0);
  narrow.range.low = std::max(narrow.range.low, -2147483648.0);
  read(key, wide, narrow);
  member = static_cast<int>(wide);
}

void TableReader::read(std::string_view key, bool& member, const base::About& about) {
  const toml::node* node = find(key, about);
  if (!node) return;
  if (const toml::value<bool>* flag = node->as_boolean())
    member = flag->get();
  else
    complaints_.value(*node, at(key),
                      {.limit = "must be true or false", .cure = fmt::format("it means: {}", about.meaning)});
}

void TableReader::read(std::string_view key, std::string& member, const base::About& about) {
  if (const toml::node* node = find(key, about)) word(*node, at(key), about, member);
}

void TableReader::read(std::string_view given, std::vector<double>& member, const base::About& own) {
  const std::optional<base::Spelling> spelling =
      own.also.empty() ? std::nullopt : spelling_in_file(given, own);
  const bool other = spelling && spelling->key != given;
  const std::string_view key = other ? spelling->key : given;
  const base::About about = other ? in_spelling(own, *spelling) : own;
  const toml::node* node = find(key, about);
  if (!node) return;
  const toml::array* items = node->as_array();
  if (!items) {
    complaints_.value(*node, at(key),
                      {.limit = "must be a list of numbers",
                       .cure = node->is_number() ? "write a single value in brackets, too: [10]"
                                                 : "write numbers in brackets: [10, 20]"});
    return;
  }
  member.clear();
  base::About item = about;
  item.range = base::allowed(about);
  std::size_t wrong = 0;
  for (std::size_t n = 0; n < items->size() && wrong <= most_told_of_a_list; ++n)
    wrong += !number(*items->get(n), fmt::format("{}[{}]", at(key), n), item, member.emplace_back());
  if (other)
    for (double& x : member) x = base::in_own_unit(x, *spelling);
}

void TableReader::read(std::string_view key, std::vector<std::string>& member, const base::About& about) {
  const toml::node* node = find(key, about);
  if (!node) return;
  const toml::array* items = node->as_array();
  if (node->is_string()) {  // a text counts as a list of one
    member.clear();
    word(*node, at(key), about, member.emplace_back());
    return;
  }
  if (!items) {
    complaints_.value(
        *node, at(key),
        {.limit = "must be a list of words", .cure = "write words in brackets: [\"a\", \"b\"]"});
    return;
  }
  member.clear();
  std::size_t wrong = 0;
  for (std::size_t n = 0; n < items->size() && wrong <= most_told_of_a_list; ++n)
    wrong += !word(*items->get(n), fmt::format("{}[{}]", at(key), n), about, member.emplace_back());
}

void TableReader::no_such_word(const toml::node& node, std::string_view key,
                               const std::vector<std::string>& words) {
  constexpr std::size_t read_at_a_glance = 12;
  const std::optional<std::string> written = node.value<std::string>();
  const std::string near = written ? nearest_word(*written, words) : std::string();
  complaints_.value(node, at(key),
                    {.limit = words.size() > read_at_a_glance
                                  ? fmt::format("is not one of the {} allowed words", words.size())
                                  : "must be " + quoted_alternatives(words),
                     .cure = near.empty() ? fmt::format("see: sixstep help {}", shown(at(key)))
                                          : fmt::format("did you mean \"{}\"?", near)});
}

void TableReader::refuse_unknown_keys() {
  for (const auto& [key, node] : table_) {
    if (std::find(known_.begin(), known_.end(), key.str()) != known_.end()) continue;
    base::Problem problem;
    if (!complaints_.full()) {
      std::vector<std::string> advised = known_;
      std::erase_if(advised, [this](const std::string& word) {
        return std::find(other_motion_.begin(), other_motion_.end(), word) != other_motion_.end();
      });
      problem = unknown_key(key.str(), advised, advice_);
    }
    complaints_.key(key, node, at(key.str()), std::move(problem));
  }
}

}  // namespace text

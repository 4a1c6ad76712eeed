// SPDX-License-Identifier: Apache-2.0
#include "text/toml/table_reader.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "sixstep/base/plausible.hpp"
#include "sixstep/study/scenario/choices.hpp"
#include "text/keys/key_advice.hpp"
#include "text/keys/key_catalog.hpp"
#include "text/keys/units.hpp"

namespace text {
namespace {

/// So many entries of one list are told of: of one with another kind of entry each would be.
constexpr std::size_t most_told_of_a_list = 5;

/// Of one [[key]].
constexpr std::size_t most_tables = 10'000;

std::string in_unit_words(const base::About& about) {
  return about.unit.empty() ? std::string() : fmt::format(", in {}", about.unit);
}

std::string cure_of(const base::About& about) {
  if (!about.cure.empty()) return std::string(about.cure);
  return fmt::format("it means: {}{}", about.meaning, in_unit_words(about));
}

std::optional<std::string> word_at(const Document& document, const std::string& path) {
  const toml::node* node = document.find(path);
  return node ? node->value<std::string>() : std::nullopt;
}

/// The control mode in the table at `path`: in one of [[at]] that of the last event up to it that changes it.
std::optional<std::string> mode_at(const Document& document, const std::string& path) {
  std::optional<std::string> mode = word_at(document, "control.mode");
  if (!path.starts_with("at[")) return mode;
  const std::string own = path.substr(0, path.find(']') + 1);
  const auto time_of = [&](const std::string& event) {
    const toml::node* node = document.find(event + ".time_s");
    return node ? node->value<double>().value_or(0.0) : 0.0;
  };
  const toml::node* events = document.find("at");
  const std::size_t count = events && events->is_array() ? events->as_array()->size() : 0;
  const double own_s = time_of(own);
  double last_s = -1.0;
  for (std::size_t n = 0; n < count; ++n) {
    const std::string event = fmt::format("at[{}]", n);
    const double time_s = time_of(event);
    if (time_s > own_s || time_s < last_s) continue;
    const std::optional<std::string> changed = word_at(document, event + ".control.mode");
    if (!changed || *changed == "same") continue;
    mode = changed;
    last_s = time_s;
  }
  return mode;
}

/// The unit that a reference has in its control mode; empty where the mode has none or is not known.
std::string mode_unit(const Document& document, const std::string& path) {
  const std::optional<std::string> word = mode_at(document, path);
  for (const auto& choice : study::mode_choices)
    if (word == choice.word) return std::string(study::reference_unit(choice.value));
  return {};
}

/// The unit of the number at a scenario's key.
std::optional<std::string> unit_at(std::string_view path) {
  for (const KeyEntry& entry : scenario_keys())
    if (entry.path == path && (entry.type == KeyType::number || entry.type == KeyType::quantity))
      return std::string(entry.about.unit);
  return {};
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
        {.limit = fmt::format("has {} tables, more than {}", node->as_array()->size(), most_tables),
         .cure = "write fewer; rows of a reference belong into a file, with shape = \"csv\""});
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

/// Empty for a plain number; nothing where it follows from a control mode that has no unit.
std::optional<std::string> TableReader::unit_of_key(const base::About& about) const {
  if (about.unit_here == "1") return std::string();
  if (!about.unit_here.empty()) return std::string(about.unit_here);
  if (!about.unit_of.empty()) return unit_at(about.unit_of);
  if (about.mode_unit.empty()) return std::string(about.unit);
  const std::string unit = mode_unit(complaints_.document(), path_);
  if (unit.empty()) return {};
  // "1" stands for a duty.
  const std::string whole = unit + std::string(about.mode_unit.substr(1));
  return whole == "1" ? std::string() : whole;
}

base::Result<double> TableReader::number_of(const toml::node& node, const base::About& about) const {
  if (const toml::value<std::string>* text = node.as_string()) {
    const std::optional<std::string> unit = unit_of_key(about);
    if (unit) return in_unit(text->get(), *unit);
    if (!about.unit_of.empty())
      return base::Problem{
          .limit = fmt::format("is in the unit of {}, which is no number here", about.unit_of),
          .cure = "name a number of the scenario, as supply.voltage_V"};
    return base::Problem{.limit = "is in the unit of control.mode, and this mode has none",
                         .cure = "set control.mode, or write a number without quotes"};
  }
  if (node.is_integer()) return static_cast<double>(node.as_integer()->get());
  if (node.is_floating_point()) return node.as_floating_point()->get();
  return base::Problem{.limit = "must be a number"};
}

/// A limit is told in the unit in which the value was written.
std::string TableReader::limit_as_written(const toml::node& node, const base::About& about, double x) const {
  const base::Range allowed = base::allowed(about);
  const toml::value<std::string>* text = node.as_string();
  const std::optional<std::string> own = text ? unit_of_key(about) : std::nullopt;
  const std::optional<Written> written = text ? split_number(text->get()) : std::nullopt;
  if (!own || own->empty() || !written || written->unit.empty()) return limit_of(about.range, allowed, x);
  const auto there = [&](double value) {
    const auto found = in_unit(fmt::format("{} {}", value, *own), written->unit);
    return found ? *found : value;
  };
  const auto in_its_unit = [&](base::Range range) {
    range.low = there(range.low);
    range.high = there(range.high);
    if (range.least != 0.0) range.least = there(range.least);
    return range;
  };
  return fmt::format("{}, in {}", limit_of(in_its_unit(about.range), in_its_unit(allowed), there(x)),
                     written->unit);
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
  base::About item = about;
  item.range = base::allowed(about);
  std::size_t wrong = 0;
  for (std::size_t n = 0; n < items->size() && wrong <= most_told_of_a_list; ++n)
    wrong += !number(*items->get(n), fmt::format("{}[{}]", at(key), n), item, member.emplace_back());
}

void TableReader::value(std::string_view key, std::vector<std::string>& member, const base::About& about) {
  const toml::node* node = find(key, about);
  if (!node) return;
  const toml::array* items = node->as_array();
  if (node->is_string()) {  // a list of one
    member.clear();
    word(*node, at(key), about, member.emplace_back());
    return;
  }
  if (!items) {
    complaints_.value(*node, at(key),
                      {.limit = "must be a list of words", .cure = "write it in brackets: [\"a\", \"b\"]"});
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
                                  ? fmt::format("is none of the {} words that it may be", words.size())
                                  : "must be " + quoted_alternatives(words),
                     .cure = near.empty() ? fmt::format("see: sixstep help {}", shown(at(key)))
                                          : fmt::format("did you mean \"{}\"?", near)});
}

void TableReader::refuse_unknown_keys() {
  for (const auto& [key, node] : table_) {
    if (std::find(known_.begin(), known_.end(), key.str()) != known_.end()) continue;
    base::Problem problem;
    if (!complaints_.full()) problem = unknown_key(key.str(), known_, advice_);
    complaints_.key(key, node, at(key.str()), std::move(problem));
  }
}

}  // namespace text

// SPDX-License-Identifier: Apache-2.0
#include "text/keys/key_catalog.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "sixstep/analysis/plan/plan_description.hpp"
#include "sixstep/base/plausible.hpp"
#include "sixstep/design/sheet/sheet_description.hpp"
#include "sixstep/study/scenario/scenario_description.hpp"
#include "text/keys/key_advice.hpp"

namespace text {
namespace {

KeyType type_of(const double&) { return KeyType::number; }
KeyType type_of(const int&) { return KeyType::whole_number; }
KeyType type_of(const bool&) { return KeyType::flag; }
KeyType type_of(const std::string&) { return KeyType::text; }
KeyType type_of(const std::vector<double>&) { return KeyType::numbers; }
KeyType type_of(const std::vector<std::string>&) { return KeyType::texts; }

std::string as_toml(double x) { return shortest(x); }
std::string as_toml(int x) { return fmt::format("{}", x); }
std::string as_toml(bool x) { return x ? "true" : "false"; }
std::string as_toml(const std::string& text) { return text.empty() ? "" : fmt::format("\"{}\"", text); }
template <class T>
std::string as_toml(const std::vector<T>&) {
  return "";
}

class Catalog final : public base::Visitor {
 public:
  std::vector<KeyEntry> take() { return std::move(entries_); }

 private:
  void visit_value(std::string_view key, const base::ValueMember& member, const base::About& about) override {
    std::visit([&](const auto* of) { note(key, *of, about); }, member);
  }
  template <class T>
  void note(std::string_view key, const T& member, const base::About& about) {
    add(key, type_of(member), about).default_value = about.required ? "" : as_toml(member);
  }
  template <class T>
  void note(std::string_view key, const std::optional<T>&, const base::About& about) {
    add(key, type_of(T{}), about).optional = true;
  }
  void visit_word(std::string_view key, base::WordMember& member, const base::About& about) override {
    KeyEntry& entry = add(key, KeyType::word, about);
    if (!about.required) entry.default_value = fmt::format("\"{}\"", member.word());
    for (std::size_t n = 0; n < member.size(); ++n) {
      const base::WordMember::Word choice = member.at(n);
      if (choice.turning.empty())
        entry.choices.emplace_back(choice.word, choice.meaning);
      else
        entry.linear_choices.push_back(
            {std::string(choice.turning), std::string(choice.word), std::string(choice.meaning)});
    }
  }
  void visit_quantity(std::string_view key, const base::QuantityMember& member,
                      const base::About& about) override {
    add(key, KeyType::quantity, about).optional =
        std::holds_alternative<std::optional<base::Quantity>*>(member);
  }
  void visit_table(std::string_view key, base::TableMember& member, const base::About& about) override {
    add(key, KeyType::table, about).optional = member.is_optional();
    const std::string outer = prefix_;
    prefix_ += std::string(key) + ".";
    member.is_optional() ? member.walk_usual(*this) : member.walk(*this);
    prefix_ = outer;
  }
  void visit_list(std::string_view key, base::ListMember& member, const base::About& about) override {
    add(key, KeyType::list, about);
    const std::string outer = prefix_;
    prefix_ += std::string(key) + ".";
    member.walk_usual(*this);
    prefix_ = outer;
  }

  KeyEntry& add(std::string_view key, KeyType type, const base::About& about) {
    return entries_.emplace_back(KeyEntry{.path = prefix_ + std::string(key), .type = type, .about = about});
  }
  std::string prefix_;
  std::vector<KeyEntry> entries_;
};

std::string type_text(const KeyEntry& entry) {
  switch (entry.type) {
    case KeyType::number:
      return "number";
    case KeyType::whole_number:
      return "whole number";
    case KeyType::flag:
      return "true or false";
    case KeyType::text:
      return "text";
    case KeyType::numbers:
      return "list of numbers";
    case KeyType::texts:
      return "list of words";
    case KeyType::word:
      return "one of the words below";
    case KeyType::quantity:
      return "number, or { value, frame, source }";
    case KeyType::table:
      return "table";
    case KeyType::list:
      return "list of tables, [[" + entry.path + "]]";
  }
  return "";
}

bool is_numeric(KeyType type) {
  return type == KeyType::number || type == KeyType::whole_number || type == KeyType::numbers ||
         type == KeyType::quantity;
}

/// Whether `path` is the key in this spelling, in the same table.
bool is_spelled(const KeyEntry& key, const base::Spelling& spelling, std::string_view path) {
  const std::size_t table = key.path.rfind('.') + 1;  // 0 for a key of the root table
  return path.size() == table + spelling.key.size() && path.ends_with(spelling.key) &&
         path.starts_with(std::string_view(key.path).substr(0, table));
}

template <class Described>
std::vector<KeyEntry> keys_of() {
  Catalog catalog;
  Described described;
  describe(catalog, described);
  return catalog.take();
}

}  // namespace

const std::vector<KeyEntry>& scenario_keys() {
  static const std::vector<KeyEntry> keys = keys_of<study::Scenario>();
  return keys;
}

const std::vector<KeyEntry>& sheet_keys() {
  static const std::vector<KeyEntry> keys = keys_of<design::Sheet>();
  return keys;
}

const std::vector<KeyEntry>& plan_keys() {
  static const std::vector<KeyEntry> keys = keys_of<analysis::PlanEntry>();
  return keys;
}

const KeyEntry* find_key(const std::vector<KeyEntry>& keys, std::string_view path) {
  const auto found = std::find_if(keys.begin(), keys.end(), [&](const KeyEntry& key) {
    return key.path == path || std::any_of(key.about.also.begin(), key.about.also.end(),
                                           [&](const base::Spelling& s) { return is_spelled(key, s, path); });
  });
  return found == keys.end() ? nullptr : &*found;
}

std::optional<std::string> key_unit(const std::vector<KeyEntry>& keys, std::string_view path) {
  const KeyEntry* entry = find_key(keys, path);
  if (!entry) return {};
  for (const base::Spelling& spelling : entry->about.also)
    if (is_spelled(*entry, spelling, path) && !spelling.unit.empty()) return std::string(spelling.unit);
  return std::string(entry->about.unit);
}

std::string help_text(const KeyEntry& entry) {
  const base::About& about = entry.about;
  std::string text = fmt::format("{}\n  {}\n  {}", entry.path, about.meaning, type_text(entry));
  if (!about.unit.empty()) text += fmt::format(", in {}", about.unit);
  if (!about.frame.empty()) text += fmt::format(", frame {}", about.frame);
  if (is_numeric(entry.type)) text += ", " + limit_of(base::allowed(about));
  if (about.required) text += "\n  required";
  if (!entry.default_value.empty()) text += "\n  default " + entry.default_value;
  std::size_t width = 12;
  for (const auto& [word, meaning] : entry.choices) width = std::max(width, word.size());
  for (const auto& [word, meaning] : entry.choices)
    text += fmt::format("\n    {:<{}}  {}", word, width, meaning);
  for (const auto& [turning, word, meaning] : entry.linear_choices)
    text += fmt::format("\n    {:<{}}  {}", word, width, meaning);
  for (const base::Spelling& spelling : about.also) text += fmt::format("\n  or as {}", spelling.key);
  return text + "\n";
}

}  // namespace text

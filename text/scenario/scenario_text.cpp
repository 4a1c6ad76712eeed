// SPDX-License-Identifier: Apache-2.0
#include "text/scenario/scenario_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "sixstep/base/written.hpp"
#include "sixstep/study/scenario/scenario_description.hpp"
#include "text/escape/escape.hpp"

namespace text {
namespace {

std::string toml(double x) { return sixstep::base::written(x); }
std::string toml(bool x) { return x ? "true" : "false"; }
std::string toml(int x) { return std::to_string(x); }
std::string toml(const std::string& text) { return toml_text(text); }
template <class T>
std::string toml(const std::vector<T>& list) {
  std::string out = "[";
  for (std::size_t n = 0; n < list.size(); ++n) out += (n ? ", " : "") + toml(list[n]);
  return out + "]";
}

/// One table's keys as they would be written, tables within it and lists behind them.
class TableText {
 public:
  template <class T>
  void value(std::string_view key, const T& member, const sixstep::base::About& about) {
    rows_.push_back({std::string(key), toml(member), about.required});
  }
  template <class T>
  void value(std::string_view key, const std::optional<T>& member, const sixstep::base::About& about) {
    if (member) value(key, *member, about);
  }
  template <class Enum, class Choices>
  void choice(std::string_view key, const Enum& member, const Choices& choices,
              const sixstep::base::About& about) {
    value(key, std::string(sixstep::base::word(choices, member)), about);
  }
  template <class Quantity>
  void quantity(std::string_view, const Quantity&, const sixstep::base::About&) {}
  template <class Struct>
  void table(std::string_view key, Struct& member, const sixstep::base::About& about) {
    if (about.partial) return;  // the motor's sheet
    add(key, member, Shown::where_it_differs);
  }
  /// One that may be left out is told by its heading, even where every row is the default.
  template <class Struct>
  void table(std::string_view key, std::optional<Struct>& member, const sixstep::base::About&) {
    Struct usual;
    add(key, member ? *member : usual, member ? Shown::always : Shown::never);
  }
  template <class Item>
  void list(std::string_view key, std::vector<Item>& items, const sixstep::base::About&) {
    Item usual;
    TableText plain;
    describe(plain, usual);
    for (Item& item : items) {
      TableText inner;
      describe(inner, item);
      lists_.emplace_back(key, inner.text(plain, std::string(key), Heading::none));
      inner.add_values(plain, fmt::format("{}[{}].", key, &item - items.data()), listed_);
    }
  }

  enum class Heading { with_rows, always, none };

  /// The rows that differ from `usual`, under the table's path; then the tables within.
  std::string text(const TableText& usual, const std::string& path, Heading heading) const {
    std::map<std::string, std::string> other;
    for (const Row& row : usual.rows_) other.emplace(row.key, row.value);
    std::string out;
    for (const Row& row : rows_) {
      const auto same = other.find(row.key);
      if (row.required || same == other.end() || same->second != row.value)
        out += fmt::format("{} = {}\n", row.key, row.value);
    }
    if (heading == Heading::always || (heading == Heading::with_rows && !out.empty()))
      out = fmt::format("\n[{}]\n", path) + out;
    for (std::size_t n = 0; n < tables_.size(); ++n) {
      const TableText& inner = tables_[n];
      if (inner.shown_ == Shown::never) continue;
      out += inner.text(usual.tables_[n], path.empty() ? inner.key_ : path + "." + inner.key_,
                        inner.shown_ == Shown::always ? Heading::always : Heading::with_rows);
    }
    for (const auto& [key, rows] : lists_) out += fmt::format("\n[[{}]]\n{}", key, rows);
    return out;
  }

  /// All rows, each under `path`; then those of the tables and lists within.
  void add_values(const TableText& usual, const std::string& path, std::vector<WrittenValue>& out) const {
    for (const Row& row : rows_) {
      const bool same = std::any_of(usual.rows_.begin(), usual.rows_.end(), [&](const Row& other) {
        return other.key == row.key && other.value == row.value;
      });
      out.push_back({path + row.key, row.value, same && !row.required});
    }
    for (std::size_t n = 0; n < tables_.size(); ++n)
      if (tables_[n].shown_ != Shown::never)
        tables_[n].add_values(usual.tables_[n], path + tables_[n].key_ + ".", out);
    for (const WrittenValue& value : listed_) out.push_back({path + value.path, value.text, value.usual});
  }

 private:
  enum class Shown { where_it_differs, always, never };
  struct Row {
    std::string key, value;
    bool required;
  };

  template <class Struct>
  void add(std::string_view key, Struct& member, Shown shown) {
    TableText inner;
    describe(inner, member);
    inner.key_ = std::string(key);
    inner.shown_ = shown;
    tables_.push_back(std::move(inner));
  }

  std::string key_;
  Shown shown_ = Shown::where_it_differs;
  std::vector<Row> rows_;
  std::vector<std::pair<std::string, std::string>> lists_;
  std::vector<TableText> tables_;
  std::vector<WrittenValue> listed_;  ///< of the lists' items
};

}  // namespace

std::string scenario_text(const study::Scenario& scenario, const std::vector<std::string>& comments) {
  study::Scenario copy = scenario, usual;
  // What was read from other files is written out: the text stands for itself, wherever it is kept.
  copy.extends.clear();
  const auto detach = [](study::Reference& r) {
    r.file.clear();
    r.column.reset();
  };
  detach(copy.reference);
  for (study::At& at : copy.at)
    if (at.reference) detach(*at.reference);
  TableText text, defaults;
  describe(text, copy);
  describe(defaults, usual);
  std::string out;
  for (const std::string& line : comments) out += "# " + visible(line) + "\n";
  return out + text.text(defaults, "", TableText::Heading::none);
}

std::vector<WrittenValue> scenario_values(const study::Scenario& scenario) {
  study::Scenario copy = scenario, usual;
  TableText text, defaults;
  describe(text, copy);
  describe(defaults, usual);
  std::vector<WrittenValue> values;
  text.add_values(defaults, "", values);
  return values;
}

}  // namespace text

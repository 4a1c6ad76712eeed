// SPDX-License-Identifier: Apache-2.0
// Collects keys that a scenario gives without effect.
#pragma once
#include <string>
#include <variant>
#include <vector>

#include "sixstep/base/visitor.hpp"
#include "sixstep/study/scenario/scenario.hpp"

namespace sixstep::study {

/// The numbers and switches of a described table, in the table's order. Keys whose value is one of several
/// words are omitted: they are never reported as unused.
class NumbersAndSwitches final : public base::Visitor {
 public:
  struct Entry {
    std::string key;
    base::ValueMember value;
  };
  template <class Table>
  static std::vector<Entry> of(Table& table) {
    NumbersAndSwitches found;
    describe(found, table);
    return found.entries_;
  }

 private:
  void visit_value(std::string_view key, const base::ValueMember& value, const base::About&) override {
    entries_.push_back({std::string(key), value});
  }

  std::vector<Entry> entries_;
};

class Unused {
 public:
  template <class Value>
  void add(const std::string& key, const Value& given, const Value& usual, const std::string& reason) {
    if (given == usual) return;
    text_ += (text_.empty() ? "" : ", ") + key + " (" + reason + ")";
  }
  /// Adds each given key of a table that has no effect at all.
  template <class Table>
  void add_table(const std::string& table, Table given, const std::string& reason) {
    Table usual;
    const auto of_given = NumbersAndSwitches::of(given), of_usual = NumbersAndSwitches::of(usual);
    for (std::size_t n = 0; n < of_given.size(); ++n)
      std::visit(
          [&]<class Value>(const Value* value) {
            add(table + '.' + of_given[n].key, *value, *std::get<Value*>(of_usual[n].value), reason);
          },
          of_given[n].value);
  }
  const std::string& text() const { return text_; }

 private:
  std::string text_;
};

/// Adds the keys of [believed] with which this drive computes nothing.
void unused_beliefs(const Scenario& scenario, Unused& out);

/// Adds the keys of [sensors] whose device is absent, or whose converter converts nothing.
void unused_of_sensors(const Scenario& scenario, Unused& out);

}  // namespace sixstep::study

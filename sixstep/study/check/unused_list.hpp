// SPDX-License-Identifier: Apache-2.0
// Collects keys that a scenario gives without effect.
#pragma once
#include <string>
#include <variant>
#include <vector>

#include "sixstep/base/visitor.hpp"
#include "sixstep/study/scenario/scenario.hpp"

namespace sixstep::study {

/// The numbers, switches and chosen words of a described table, each kind in the table's order.
class GivenKeys final : public base::Visitor {
 public:
  struct Entry {
    std::string key;
    base::ValueMember value;
  };
  struct Word {
    std::string key, word;
  };
  std::vector<Entry> entries;
  std::vector<Word> words;

  template <class Table>
  static GivenKeys of(Table& table) {
    GivenKeys found;
    describe(found, table);
    return found;
  }

 private:
  void visit_value(std::string_view key, const base::ValueMember& value, const base::About&) override {
    entries.push_back({std::string(key), value});
  }
  void visit_word(std::string_view key, base::WordMember& member, const base::About&) override {
    words.push_back({std::string(key), std::string(member.word())});
  }
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
    const GivenKeys of_given = GivenKeys::of(given), of_usual = GivenKeys::of(usual);
    for (std::size_t n = 0; n < of_given.entries.size(); ++n)
      std::visit(
          [&]<class Value>(const Value* value) {
            add(table + '.' + of_given.entries[n].key, *value, *std::get<Value*>(of_usual.entries[n].value),
                reason);
          },
          of_given.entries[n].value);
    for (std::size_t n = 0; n < of_given.words.size(); ++n)
      add(table + '.' + of_given.words[n].key, of_given.words[n].word, of_usual.words[n].word, reason);
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

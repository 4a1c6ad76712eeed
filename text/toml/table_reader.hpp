// SPDX-License-Identifier: Apache-2.0
// Fills a described struct from a TOML table and reports every value that does not fit.
#pragma once
#include <algorithm>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "sixstep/base/result.hpp"
#include "sixstep/base/visitor.hpp"
#include "text/keys/units.hpp"
#include "text/rooms.hpp"
#include "text/toml/complaints.hpp"

namespace text {

class TableReader final : public base::Visitor {
 public:
  /// `path`: path of the table; empty for the file itself. `partial`: no key is required. `advice`: the cure
  /// for a key that is unlike all keys of the table; if it is empty, the keys are listed.
  TableReader(const toml::table& table, std::string path, Complaints& complaints, bool partial,
              std::string_view advice = {})
      : table_(table), path_(std::move(path)), complaints_(complaints), partial_(partial), advice_(advice) {}

  /// Reports every key that no description has named. Call it last.
  void refuse_unknown_keys();

 private:
  void visit_value(std::string_view key, const base::ValueMember& member, const base::About& about) override;
  void visit_quantity(std::string_view key, const base::QuantityMember& member,
                      const base::About& about) override;
  void visit_word(std::string_view key, base::WordMember& member, const base::About& about) override;
  void visit_table(std::string_view key, base::TableMember& member, const base::About& about) override;
  void visit_list(std::string_view key, base::ListMember& member, const base::About& about) override;

  void read(std::string_view key, double& member, const base::About& about);
  void read(std::string_view key, int& member, const base::About& about);
  void read(std::string_view key, std::int64_t& member, const base::About& about);
  void read(std::string_view key, bool& member, const base::About& about);
  void read(std::string_view key, std::string& member, const base::About& about);
  void read(std::string_view key, std::vector<double>& member, const base::About& about);
  void read(std::string_view key, std::vector<std::string>& member, const base::About& about);
  void read(std::string_view key, base::Quantity& member, const base::About& about);
  void read(std::string_view key, std::optional<base::Quantity>& member, const base::About& about);
  template <class T>
  void read(std::string_view key, std::optional<T>& member, const base::About& about);

  std::string at(std::string_view key) const {
    return path_.empty() ? std::string(key) : path_ + "." + std::string(key);
  }
  bool given(std::string_view key) const { return table_.contains(key); }
  const toml::node* find(std::string_view key, const base::About& about);
  void absent(std::string_view key, const base::About& about) {
    find(key, about);
    for (const base::Spelling& spelling : about.also) {
      known_.emplace_back(spelling.key);
      if (spelling.linear && !complaints_.linear_motor()) other_motion_.emplace_back(spelling.key);
    }
  }
  bool any_spelling_in_file(std::string_view key, const base::About& about) const {
    return given(key) || std::any_of(about.also.begin(), about.also.end(),
                                     [&](const base::Spelling& spelling) { return given(spelling.key); });
  }
  /// The wanted unit, with the key's frames, and the pole pairs if known.
  Wanted wanted_in(const std::string& unit, const base::About& about) const;
  void frame_of_unit(const toml::node& node, const std::string& path, const base::About& about,
                     base::Quantity& quantity);
  /// Finds which of a quantity's keys the table contains, and marks all of them as known. A table that
  /// contains two of these keys is a mistake.
  std::optional<base::Spelling> spelling_in_file(std::string_view key, const base::About& about);
  void parts(const toml::table& table, const std::string& path, const base::About& about,
             const base::Spelling& spelling, base::Quantity& out);
  void interval(const toml::node& node, const std::string& path, const base::About& about, int ten,
                base::Quantity& out);
  std::optional<double> last_digit(const toml::node& node, const std::string& path, const base::About& about,
                                   int ten) const;
  /// The word that this motor has in place of a word that only the other kind of motor has; empty if `word`
  /// is valid for this motor.
  std::string_view of_other_motion(const base::WordMember& words, const base::WordMember::Word& word) const;
  const toml::table* find_table(std::string_view key, const base::About& about);
  const toml::array* find_tables(std::string_view key, const base::About& about);
  /// A number in the allowed range. It replaces a refused number, so that later checks can continue.
  static double within(const base::About& about);
  /// The unit in which a key's number is written, and the factor between this unit and the key's unit. Both
  /// units differ for a linear motor and for another spelling.
  struct WrittenIn {
    std::string unit;
    double factor = 1.0;
  };
  std::optional<WrittenIn> unit_of_key(const base::About& about) const;
  base::Result<double> number_of(const toml::node& node, const base::About& about) const;
  std::string limit_as_written(const toml::node& node, const base::About& about, double x) const;
  bool number(const toml::node& node, const std::string& path, const base::About& about, double& out);
  bool word(const toml::node& node, const std::string& path, const base::About& about, std::string& out);
  void frame(const toml::node& node, const std::string& path, const base::About& about,
             base::Quantity& quantity);
  void no_such_word(const toml::node& node, std::string_view key, const std::vector<std::string>& words);

  const toml::table& table_;
  std::string path_;
  Complaints& complaints_;
  bool partial_;
  std::string_view advice_;
  std::vector<std::string> known_;
  std::vector<std::string>
      other_motion_;      ///< words of the other kind of motor among `known_`; they are never suggested
  bool refused_ = false;  ///< true: a number was out of its range
  bool lost_word_ =
      false;  ///< true: a choice could not be read, so that the unit that it determines is unknown
};

/// Fills the struct from the whole file.
template <class Struct>
void read_root(const Document& document, Struct& into, Complaints& complaints) {
  TableReader reader(document.root(), "", complaints, false);
  describe(reader, into);
  reader.refuse_unknown_keys();
}

}  // namespace text

// SPDX-License-Identifier: Apache-2.0
// Everything wrong with a file, collected and told in the order of its lines.
#pragma once
#include <functional>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "text/rooms.hpp"
#include "text/toml/document.hpp"

namespace text {

class Complaints {
 public:
  explicit Complaints(const Document& document) : document_(document) {}

  /// Whether the document speaks of a motor that moves along a line: units that follow from others are then its own.
  bool linear_motor() const { return linear_motor_; }
  void set_linear_motor(bool linear) { linear_motor_ = linear; }

  /// Those of the motor that the document speaks of, where it has any: electrical turns convert by them.
  std::optional<int> pole_pairs() const { return pole_pairs_; }
  void set_pole_pairs(std::optional<int> pole_pairs) { pole_pairs_ = pole_pairs; }

  /// About the value at `path`, which is quoted.
  void value(const toml::node& node, std::string_view path, base::Problem problem);
  /// About the key itself.
  void key(const toml::key& key, const toml::node& node, std::string_view path, base::Problem problem);
  /// About something that is not there: told where its table stands.
  void missing(std::string_view path, base::Problem problem);
  /// About a path that a later check names; it stands at the value, else at the nearest table.
  void later(base::Problem problem);

  /// A key or a word at `path` that only the other kind of motor has.
  void other_motion(std::string_view path, const std::string& instead) {
    later({.where = std::string(path),
           .limit = linear_motor_ ? "is a turning motor's, and this one is linear"
                                  : "is a linear motor's, and this one turns",
           .cure = "write " + instead});
  }

  /// The table that `path` lies in is told of elsewhere, in a file that it names.
  void told_elsewhere(std::string_view path);

  /// Whether something in the table that `path` lies in has been complained about already.
  bool about_table_of(std::string_view path) const;

  /// Whether something has been complained about at the key itself or in its value.
  bool about(std::string_view key) const;

  const Document& document() const { return document_; }
  bool empty() const { return found_.empty(); }
  /// So many mistakes have been told that nobody reads the next one: it is counted only.
  bool full() const { return found_.size() >= most_told; }
  base::Problems in_order() const;

 private:
  struct Found {
    std::size_t file;  ///< as Document::order_of
    toml::source_position at;
    base::Problem problem;
  };
  static constexpr std::size_t most_told = 100;
  /// Of the table, and of the item of a list that it lies in.
  void told(std::string_view path);
  void add(const toml::source_region& at, std::string place, std::string_view path, base::Problem problem);
  /// True where there is no room for it any more.
  bool left_out(std::string_view path);

  const Document& document_;
  bool linear_motor_ = false;
  std::optional<int> pole_pairs_;
  std::size_t left_out_ = 0;
  std::vector<Found> found_;
  std::set<std::string> tables_;
  std::set<std::string, std::less<>> keys_;  ///< told of, and the tables that they lie in
};

/// "require.max" for "require[1].max": the line number already tells which.
std::string shown(std::string_view path);

}  // namespace text

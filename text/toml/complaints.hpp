// SPDX-License-Identifier: Apache-2.0
// Collects everything that is wrong with a file, in the order of its lines.
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

  /// Whether the document's motor is linear. Units that follow from other keys are then the units of a linear
  /// motor.
  bool linear_motor() const { return linear_motor_; }
  void set_linear_motor(bool linear) { linear_motor_ = linear; }

  /// Pole pairs of the document's motor, if given, with which electrical turns are converted.
  std::optional<int> pole_pairs() const { return pole_pairs_; }
  void set_pole_pairs(std::optional<int> pole_pairs) { pole_pairs_ = pole_pairs; }

  /// Reports a mistake in the value at `path` and quotes the value.
  void value(const toml::node& node, std::string_view path, base::Problem problem);
  /// Reports a mistake in the key itself.
  void key(const toml::key& key, const toml::node& node, std::string_view path, base::Problem problem);
  /// Reports a missing key at the place of its table.
  void missing(std::string_view path, base::Problem problem);
  /// Reports the problem of a later check; its `where` is a path. The reported place is the place of the
  /// value. If the file has no such value, it is the place of the nearest table.
  void later(base::Problem problem);

  /// Reports a key or a word at `path` that only the other kind of motor has.
  void other_motion(std::string_view path, const std::string& instead) {
    later({.where = std::string(path),
           .limit = linear_motor_ ? "applies to rotary motors only, and this motor is linear"
                                  : "applies to linear motors only, and this motor is rotary",
           .cure = "write " + instead});
  }

  /// Marks the table of `path` as reported, because the mistake is in a file that the table names.
  void told_elsewhere(std::string_view path);

  /// Whether a mistake in the table of `path` has been reported.
  bool about_table_of(std::string_view path) const;

  /// Whether a mistake at the key itself or in its value has been reported.
  bool about(std::string_view key) const;

  const Document& document() const { return document_; }
  bool empty() const { return found_.empty(); }
  /// Whether the largest number of reported mistakes is reached. Further mistakes are only counted, because a
  /// longer list does not help.
  bool full() const { return found_.size() >= most_told; }
  base::Problems in_order() const;

 private:
  struct Found {
    std::size_t file;  ///< number of the file, as given by Document::order_of()
    toml::source_position at;
    base::Problem problem;
  };
  static constexpr std::size_t most_told = 100;
  /// Marks the table of `path` and the list item that contains the table.
  void told(std::string_view path);
  void add(const toml::source_region& at, std::string place, std::string_view path, base::Problem problem);
  /// Counts the mistake and returns true if full().
  bool left_out(std::string_view path);

  const Document& document_;
  bool linear_motor_ = false;
  std::optional<int> pole_pairs_;
  std::size_t left_out_ = 0;
  std::vector<Found> found_;
  std::set<std::string> tables_;
  std::set<std::string, std::less<>> keys_;  ///< reported keys and the tables that contain them
};

/// A path for messages: "require.max" for "require[1].max", because the line number identifies the item.
std::string shown(std::string_view path);

}  // namespace text

// SPDX-License-Identifier: Apache-2.0
// One description of a parameter feeds every face: TOML reading and its checks, `sixstep help KEY`, and later
// the web form, the schema, Python and FMU. For each parameter struct S there is one free function template
//
//   template <class Visitor> void describe(Visitor& v, S& s);
//
// that walks the members in reading order and calls on the visitor, per member,
//   v.value(key, member, about)            double, int, std::int64_t, bool, std::string,
//   std::optional<double>,
//                                          std::vector<double>, std::vector<std::string>
//   v.choice(key, member, choices, about)  an enum, by its words: choices is an array of Choice
//   v.quantity(key, member, about)         Quantity: a number with frame and source
//   v.table(key, member, about)            a described struct
//   v.list(key, member, about)             std::vector of a described struct, TOML's [[key]]
// The default of a member is what a default-constructed S holds.
#pragma once
#include <limits>
#include <string>
#include <string_view>

namespace sixstep::base {

/// Range of a number. Open ends are the default; `above`/`below` exclude the bound, `from`/`to` include it.
struct Range {
  double low = -std::numeric_limits<double>::infinity();
  double high = std::numeric_limits<double>::infinity();
  bool low_included = true;
  bool high_included = true;

  constexpr bool holds(double x) const {  // NaN is in no range
    return (low_included ? x >= low : x > low) && (high_included ? x <= high : x < high) &&
           x - x == 0.0;  // finite
  }
};
constexpr Range above(double low) { return {.low = low, .low_included = false}; }
constexpr Range from(double low) { return {.low = low}; }
constexpr Range between(double low, double high) { return {.low = low, .high = high}; }
constexpr Range strictly_between(double low, double high) { return {low, high, false, false}; }

/// What a face must know of one key.
struct About {
  std::string_view meaning;    ///< one plain sentence, no full stop
  std::string_view unit = "";  ///< "V", "rad/s"; empty for counts, words and ratios
  std::string_view frame =
      "";            ///< allowed frames, '|' between: "terminal|phase"; empty where only one exists
  Range range = {};  ///< of the number as written
  bool required = false;
  std::string_view cure = "";  ///< what to write instead; empty: derived from range and unit
  bool partial = false;  ///< a table that changes single values of what is filled already: none is required
};

/// One word of an enumeration as written in files, and what it means.
template <class Enum>
struct Choice {
  std::string_view word;
  Enum value;
  std::string_view meaning;
};

/// The word of a value; empty for a value that has none.
template <class Choices, class Enum>
constexpr std::string_view word(const Choices& choices, Enum value) {
  for (const auto& choice : choices)
    if (choice.value == value) return choice.word;
  return {};
}

/// A number as printed, with the frame it is meant in and where it comes from.
/// In TOML: `key = 1.03` or `key = { value = 1.03, frame = "terminal", source = "data sheet, line 10" }`.
/// Where About::frame names several candidates the frame must be written (io checks it).
struct Quantity {
  double value = 0.0;
  std::string frame;
  std::string source;
};

}  // namespace sixstep::base

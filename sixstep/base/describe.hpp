// SPDX-License-Identifier: Apache-2.0
// One description of a parameter feeds every face: TOML reading and its checks, help and the schema, and later
// the web form, Python and FMU. For each parameter struct S there is one free function
//
//   void describe(Visitor& v, S& s);          (base/visitor.hpp)
//
// that walks the members in reading order and calls on the visitor, per member,
//   v.value(key, member, about)            double, int, bool, std::string,
//                                          std::optional<double>, std::vector<double>, std::vector<std::string>
//   v.choice(key, member, choices, about)  an enum, by its words: choices is an array of Choice
//   v.quantity(key, member, about)         Quantity: a number with frame and source
//   v.table(key, member, about)            a described struct, or a std::optional of one
//   v.list(key, member, about)             std::vector of a described struct, TOML's [[key]]
// The default of a member is what a default-constructed S holds.
#pragma once
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace sixstep::base {

/// Range of a number. Open ends are the default; `above`/`below` exclude the bound, `from`/`to` include it.
struct Range {
  double low = -std::numeric_limits<double>::infinity();
  double high = std::numeric_limits<double>::infinity();
  bool low_included = true;
  bool high_included = true;
  double least = 0.0;  ///< size of the smallest number that is not 0

  constexpr bool holds(double x) const {  // NaN is in no range
    return (low_included ? x >= low : x > low) && (high_included ? x <= high : x < high) &&
           (x == 0.0 || x >= least || x <= -least) && x - x == 0.0;  // finite
  }
};
constexpr Range above(double low) { return {.low = low, .low_included = false}; }
constexpr Range from(double low) { return {.low = low}; }
constexpr Range between(double low, double high) { return {.low = low, .high = high}; }
constexpr Range strictly_between(double low, double high) { return {low, high, false, false}; }

/// Another key for the same value, as another sheet prints it: in another unit, or under a line's number.
struct Spelling {
  std::string_view key;
  int ten = 0;                   ///< the key's own unit is the value written times 10 to this power
  std::string_view unit = "";    ///< of the value written; empty: the key's own
  std::string_view frame = "";   ///< the only frame it can have; empty: as the key
  std::string_view source = "";  ///< what the spelling itself says of the source: "data sheet, line 10"
  double factor = 1.0;           ///< and times this
  bool linear = false;           ///< the word where the motor is linear, and only there (base/linear.hpp)
};

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
  std::span<const Spelling> also = {};  ///< other keys for the same quantity; a file uses one of them
  std::string_view mode_unit = "";      ///< the unit follows from control.mode: "*" is that of its reference,
                                        ///< "*/s" that per second
  std::string_view unit_here =
      "";                         ///< the unit as what was read before decides: that of a figure or a signal
  std::string_view unit_of = "";  ///< path of the key whose unit it has
};

/// One word of an enumeration as written in files, and what it means.
template <class Enum>
struct Choice {
  std::string_view word;
  Enum value;
  std::string_view meaning;
  std::string_view turning = "";  ///< only of a linear motor: the turning one's word that it stands for
};

/// The word of a value; empty for a value that has none.
template <class Choices, class Enum>
constexpr std::string_view word(const Choices& choices, Enum value) {
  for (const auto& choice : choices)
    if (choice.value == value) return choice.word;
  return {};
}

/// How far a number can be trusted.
enum class Trust : std::uint8_t {
  unstated,
  sheet,     ///< the maker's print
  measured,  ///< by somebody else, on one motor
  derived,   ///< computed from other values
};

inline constexpr Choice<Trust> trust_choices[] = {
    {"sheet", Trust::sheet, "the maker's print"},
    {"measured", Trust::measured, "by somebody else, on one motor"},
    {"derived", Trust::derived, "computed from other values"},
};

struct Interval {
  double low = 0.0;
  double high = 0.0;
  bool operator==(const Interval&) const = default;
};

/// A number as printed, with the frame it is meant in and where it comes from.
/// In TOML: `key = 1.03` or `key = { value = 1.03, frame = "terminal", source = "data sheet, line 10" }`,
/// and where it helps `kind = "measured"`, and `range = [0.978, 1.03]` where sources differ.
/// Where About::frame names several candidates the frame must be written; the struct's own check demands it,
/// for it can say what each candidate would mean.
struct Quantity {
  double value = 0.0;
  std::string frame;
  std::string source;
  Trust kind = Trust::unstated;
  std::optional<Interval> range = {};     ///< what other sources say, this value included
  std::string key = {};                   ///< the spelling in the file; empty: the key's own
  std::optional<double> last_digit = {};  ///< weight of the last digit as written in the file: 0.1 for 36.0
};

}  // namespace sixstep::base

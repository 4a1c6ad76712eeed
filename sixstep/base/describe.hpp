// SPDX-License-Identifier: Apache-2.0
// Each parameter is described once. All interfaces use this description: TOML reader, help, schema, Python.
// For each parameter struct S there is one free function
//
//   void describe(Visitor& v, S& s);          (base/visitor.hpp)
//
// describe() visits the members in the order of the help. For each member it calls one of these functions of
// the visitor:
//   v.value(key, member, about)            double, int, bool, std::string,
//                                          std::optional<double>, std::vector<double>, std::vector<std::string>
//   v.choice(key, member, choices, about)  an enum, by its words: choices is an array of Choice
//   v.quantity(key, member, about)         Quantity: a number with frame and source
//   v.table(key, member, about)            a described struct, or a std::optional of a described struct
//   v.list(key, member, about)             std::vector of a described struct, TOML's [[key]]
// The default of a member is its value in a default-constructed S.
#pragma once
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace sixstep::base {

/// Range of a number. The defaults are unbounded. above() and strictly_between() exclude the bounds, from()
/// and between() include them.
struct Range {
  double low = -std::numeric_limits<double>::infinity();
  double high = std::numeric_limits<double>::infinity();
  bool low_included = true;
  bool high_included = true;
  double least = 0.0;  ///< least magnitude of a number other than 0

  constexpr bool holds(double x) const {  // NaN is in no range
    return (low_included ? x >= low : x > low) && (high_included ? x <= high : x < high) &&
           (x == 0.0 || x >= least || x <= -least) && x - x == 0.0;  // finite
  }
};
constexpr Range above(double low) { return {.low = low, .low_included = false}; }
constexpr Range from(double low) { return {.low = low}; }
constexpr Range between(double low, double high) { return {.low = low, .high = high}; }
constexpr Range strictly_between(double low, double high) { return {low, high, false, false}; }

/// Another key for the same value, because data sheets differ: another unit, another name, or a linear motor.
struct Spelling {
  std::string_view key;
  int ten = 0;                    ///< value in the unit of the key = 10^ten times the written value
  std::string_view unit = "";     ///< unit of the written value; empty: the key's unit
  std::string_view frame = "";    ///< the only possible frame of a value with this spelling; empty: the key's
                                  ///< frames
  std::string_view source = "";   ///< source that follows from the spelling: "data sheet, line 10"
  std::string_view meaning = "";  ///< meaning of the value in `frame`; empty: the key's meaning
  double factor = 1.0;            ///< additional factor on the written value
  bool linear = false;            ///< true: the spelling is for linear motors only (base/linear.hpp)
};

/// Description of one key, for all interfaces.
struct About {
  std::string_view meaning;     ///< one or two plain sentences, no full stop at the end
  std::string_view unit = "";   ///< "V", "rad/s"; empty for counts, words and ratios
  std::string_view frame = "";  ///< allowed frames, '|' between: "terminal|phase"; empty if only one exists
  Range range = {};             ///< range of the written number
  bool required = false;
  std::string_view cure = "";  ///< remedy in messages: what to write instead; empty: derived from range and
                               ///< unit
  bool partial = false;        ///< true: the table changes single values of a complete table; no key in it is
                               ///< required
  std::span<const Spelling> also = {};  ///< other keys for the same quantity; a file uses one of them
  std::string_view mode_unit = "";      ///< "*": the unit of the reference in control.mode; "*/s": this unit
                                        ///< per second
  std::string_view unit_here =
      "";  ///< unit that follows from values read before, such as the unit of a figure or a signal
  std::string_view unit_of = "";  ///< path of the key whose value selects the unit
};

/// One word of an enumeration as written in files, with its meaning.
template <class Enum>
struct Choice {
  std::string_view word;
  Enum value;
  std::string_view meaning;
  std::string_view turning = "";  ///< for a linear motor's word: the rotary motor's word that it replaces
};

/// The word for a value; empty if no choice has this value.
template <class Choices, class Enum>
constexpr std::string_view word(const Choices& choices, Enum value) {
  for (const auto& choice : choices)
    if (choice.value == value) return choice.word;
  return {};
}

/// Origin of a number, which determines its reliability.
enum class Trust : std::uint8_t {
  unstated,
  sheet,     ///< printed by the maker
  measured,  ///< measured by another source on one motor
  derived,   ///< computed from other values
};

inline constexpr Choice<Trust> trust_choices[] = {
    {"sheet", Trust::sheet, "printed by the maker"},
    {"measured", Trust::measured, "measured by another source, on one motor"},
    {"derived", Trust::derived, "computed from other values"},
};

struct Interval {
  double low = 0.0;
  double high = 0.0;
  bool operator==(const Interval&) const = default;
};

/// A number as printed, with its frame and source.
///
/// In TOML: `key = 1.03` or `key = { value = 1.03, frame = "terminal", source = "data sheet, line 10" }`.
/// Useful additions are `kind = "measured"`, and `range = [0.978, 1.03]` if sources differ. If About::frame
/// lists several frames, the file must name one. The check of the struct that contains the quantity requires
/// the frame, because this check can explain each frame.
struct Quantity {
  double value = 0.0;
  std::string frame;
  std::string source;
  Trust kind = Trust::unstated;
  std::optional<Interval> range = {};     ///< least and greatest value of all sources, `value` included
  std::string key = {};                   ///< the spelling that the file used; empty: the key itself
  std::optional<double> last_digit = {};  ///< weight of the last digit in the file: 0.1 for 36.0
};

}  // namespace sixstep::base

// SPDX-License-Identifier: Apache-2.0
// What a number in a drive can be at all, by its unit: the one table that every number is held to which
// enters, from a file, the command line, a table of rows or another program. It is as wide as physics on a
// bench, so that it refuses only slips (1e308, a unit forgotten), and narrow enough that no product of a few
// such numbers leaves what a double holds. Where a key knows better, its own range is the narrower one.
#pragma once
#include <string_view>

#include "sixstep/base/describe.hpp"

namespace sixstep::base {

struct Plausible {
  std::string_view unit;
  double least;  ///< of what must be above 0
  double most;   ///< of either sign
};

/// Between any two lie more than three powers of ten of what has been built.
inline constexpr Plausible plausible_numbers[] = {
    {"V", 1e-6, 1e5},         {"A", 1e-9, 1e6},          {"mA", 1e-6, 1e9},        {"ohm", 1e-6, 1e6},
    {"mH", 1e-6, 1e6},        {"F", 1e-12, 1e4},         {"s", 1e-12, 9e6},        {"ms", 1e-9, 9e9},
    {"Hz", 1e-6, 1e12},       {"rad/s", 1e-9, 1e6},      {"rpm", 1e-6, 1e7},       {"rad", 1e-9, 1e6},
    {"deg", 1e-9, 1e9},       {"N m", 1e-12, 1e6},       {"Nm", 1e-12, 1e6},       {"mNm", 1e-9, 1e9},
    {"N m s", 1e-15, 1e6},    {"kg m2", 1e-15, 1e9},     {"g cm2", 1e-8, 1e16},    {"mNm/A", 1e-6, 1e7},
    {"Nm/A", 1e-9, 1e4},      {"mV s", 1e-6, 1e7},       {"V/krpm", 1e-6, 1e6},    {"mWb", 1e-6, 1e6},
    {"rpm/V", 1e-6, 1e7},     {"T", 1e-6, 100},          {"mm", 1e-3, 1e5},        {"rpm/mNm", 1e-9, 1e9},
    {"K/W", 1e-6, 1e6},       {"degC", 1e-6, 1e4},       {"percent", 1e-6, 100},   {"A/V", 1e-9, 1e9},
    {"A s/rad", 1e-9, 1e9},   {"deg s/rad", 1e-9, 1e9},  {"rad/s/deg", 1e-9, 1e9}, {"H", 1e-12, 1e4},
    {"N m/rad", 1e-9, 1e12},  {"N m s/rad", 1e-15, 1e6}, {"N m s2", 1e-18, 1e3},   {"kg/m3", 1e-3, 1e5},
    {"N", 1e-12, 1e6},        {"kg", 1e-15, 1e9},        {"m/s", 1e-9, 1e6},       {"m", 1e-9, 1e6},
    {"N s/m", 1e-15, 1e6},    {"N/m", 1e-9, 1e12},       {"N s2/m2", 1e-18, 1e3},  {"N/A", 1e-9, 1e4},
    {"V s/m", 1e-9, 1e4},     {"A h", 1e-9, 1e6},        {"J", 1e-15, 1e6},        {"C", 1e-15, 1e6},
    {"percent/K", 1e-6, 100}, {"rad/s2", 1e-9, 1e12},    {"rad/s3", 1e-9, 1e18},   {"m/s2", 1e-9, 1e12},
    {"m/s3", 1e-9, 1e18},
};

/// Gains, ratios and what is in a unit of its own.
inline constexpr Plausible any_number = {"", 1e-12, 1e12};

/// Below it a number is 0 to every formula here, but its inverse or its square is none any more.
inline constexpr double nearly_nothing = 1e-30;

constexpr Plausible plausible(std::string_view unit) {
  for (const Plausible& row : plausible_numbers)
    if (row.unit == unit) return row;
  return any_number;
}

/// A range with its open ends closed by what is plausible in the unit.
constexpr Range allowed(Range range, std::string_view unit) {
  const Plausible number = plausible(unit);
  constexpr double endless = std::numeric_limits<double>::infinity();
  if (range.high == endless) range.high = number.most;
  if (range.low == -endless) range.low = -number.most;
  range.least = range.low == 0 && !range.low_included ? number.least : nearly_nothing;
  return range;
}

/// What a key's number may be. Where its unit follows from other keys, any number may stand there.
constexpr Range allowed(const About& about) { return allowed(about.range, about.unit); }

}  // namespace sixstep::base

// SPDX-License-Identifier: Apache-2.0
// The table of plausible numbers for each unit. Every number from a file, the command line, a table of rows
// or another program must be in the range of its unit. The ranges reject only mistakes, such as 1e308 or a
// forgotten unit. Products of a few allowed numbers do not overflow a double. A key may have a narrower
// range.
#pragma once
#include <string_view>

#include "sixstep/base/describe.hpp"

namespace sixstep::base {

struct Plausible {
  std::string_view unit;
  double least;  ///< least value of a number that must be above 0
  double most;   ///< largest magnitude
};

/// Each interval spans more than three powers of ten and contains the values of built motors.
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

/// Limits for gains, ratios, and numbers whose unit is not in the table.
inline constexpr Plausible any_number = {"", 1e-12, 1e12};

/// Least magnitude of a number that is not 0. A smaller number has the same effect as 0 in formulas, but its
/// inverse or its square would exceed the range of a double.
inline constexpr double nearly_nothing = 1e-30;

constexpr Plausible plausible(std::string_view unit) {
  for (const Plausible& row : plausible_numbers)
    if (row.unit == unit) return row;
  return any_number;
}

/// The range, with its open ends replaced by the plausible limits of the unit.
constexpr Range allowed(Range range, std::string_view unit) {
  const Plausible number = plausible(unit);
  constexpr double endless = std::numeric_limits<double>::infinity();
  if (range.high == endless) range.high = number.most;
  if (range.low == -endless) range.low = -number.most;
  range.least = range.low == 0 && !range.low_included ? number.least : nearly_nothing;
  return range;
}

/// The allowed range of a key's number. If other keys determine the unit, the limits of any_number apply.
constexpr Range allowed(const About& about) { return allowed(about.range, about.unit); }

}  // namespace sixstep::base

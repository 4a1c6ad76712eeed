// SPDX-License-Identifier: Apache-2.0
// Measures resistance and time constant of a phase. The rotor rests in the direction of the voltage, which
// steps between two levels. The currents have the same signs at both levels. Dead time and diodes therefore
// subtract the same voltage at both levels, and this voltage cancels in the differences:
//
//   R = (V_2 - V_1)/(I_2 - I_1),     lost voltage: V_2 - R I_2
//
// V is the vector's length times the bus voltage, and I the mean current of a level's last quarter. After a
// step, the area between the current and its final value is tau (I_2 - I_1). Neither the rotor's motion nor
// the lost voltage changes this area:
//
//   S = sum (I_end - i_k)/(I_2 - I_1) over the ticks of a step, minus the delay from a sample to its voltage
//   x = T/tau:  S = coth(x/2)/2 for samples at the ends of periods, 1/(2 sinh(x/2)) for samples in the
//               middles of periods
//   tau/T = S - 1/(12 S)  or  S + 1/(24 S),                              exact to x^4/720 and x^4/640
//
// T is the control period, tau = L/R the time constant, i_k the current at tick k and I_end its final value.
// Steps up and down alternate, and their areas are added. The converters' rounding changes I_2 - I_1 by at
// most 4/3 of a count (2/3 in each mean, by 2 i_a - i_b - i_c). If I_2 - I_1 is n counts, rounding changes S
// by the fraction ln(2 n)/n.
#pragma once
#include <cstdint>

#include "sixstep/control/commissioning/field_vector.hpp"

namespace sixstep::control {

struct LevelStepsConfig {
  /// Ticks of a level, a multiple of 4. Choose ten time constants: the current is then constant in the last
  /// quarter.
  std::uint16_t ticks = 1024;
  std::uint16_t pairs = 4;           ///< number of pairs; a pair is a step up and a step down
  std::uint8_t late_half_ticks = 1;  ///< delay from a sample until its output acts at the legs: 0, 1 or 2
                                     ///< half ticks
  bool operator==(const LevelStepsConfig&) const = default;
};

/// Sums over all steps to one level.
struct LevelSums {
  std::int64_t all = 0;   ///< sum of the currents of all ticks
  std::int64_t tail = 0;  ///< sum of the currents in the steps' last quarters
  std::int64_t bus = 0;   ///< sum of the bus counts in the steps' last quarters
};

struct LevelStepsState {
  LevelSums level[2]{};     ///< the lower level, the higher level
  std::uint16_t tick = 0;   ///< tick within the step
  std::uint16_t steps = 0;  ///< completed steps; the sums skip the first two
  bool high = false;
};

/// Results, as integers.
struct LevelStepsReading {
  bool usable = false;                 ///< true: the levels differ by 64 counts or more, and R and tau are
                                       ///< above 0
  std::int32_t resistance = 0;         ///< 2^-20 bus counts per current count
  std::int32_t tau = 0;                ///< time constant, 2^-16 ticks
  std::int32_t lost = 0;               ///< voltage that dead time and diodes subtract, 2^-8 bus counts
  std::int32_t higher = 0, lower = 0;  ///< mean currents at the two levels, 24ths of a count
};

/// Adds one tick's sample of the current along the vector; returns true when the last step is complete.
constexpr bool level_steps_tick(const LevelStepsConfig& config, LevelStepsState& state, std::int32_t along,
                                std::uint16_t bus_counts) {
  const auto quarter = static_cast<std::uint16_t>(config.ticks / 4);
  if (state.steps >= 2) {
    LevelSums& sums = state.level[state.high ? 1 : 0];
    sums.all += along;
    if (state.tick >= static_cast<std::uint16_t>(3 * quarter)) {
      sums.tail += along;
      sums.bus += bus_counts;
    }
  }
  if (++state.tick < 4 * quarter) return false;
  state.tick = 0;
  state.high = !state.high;
  return ++state.steps >= static_cast<std::uint16_t>(2 * config.pairs + 2);
}

namespace detail {

/// x/y, rounded to nearest; 0 for y = 0.
constexpr std::int64_t ratio_of(std::int64_t x, std::int64_t y) {
  return y == 0 ? 0 : divided<std::int64_t>(x, y);
}

constexpr std::int32_t held_to_32(std::int64_t x) { return saturated<std::int32_t>(x); }

/// Time constant from the area of a step divided by its height, both in 2^-16 ticks. The sample whose output
/// begins a step still belongs to the step before.
constexpr std::int64_t tau_of_area(std::int64_t area, std::uint8_t late_half_ticks) {
  constexpr std::int64_t tick = std::int64_t{1} << 16;
  const std::int64_t S = area + (1 - late_half_ticks) * (tick / 2);
  if (S <= 0) return 0;
  return late_half_ticks % 2 == 0 ? S - ratio_of(tick * tick, 12 * S) : S + ratio_of(tick * tick, 24 * S);
}

}  // namespace detail

/// Result for two vectors of lengths `low` and `high`, in units of 2^-20 of the bus.
constexpr LevelStepsReading level_steps_reading(const LevelStepsConfig& config, const LevelStepsState& state,
                                                std::int32_t low, std::int32_t high) {
  const LevelSums &lower = state.level[0], &higher = state.level[1];
  const std::int64_t quarter = config.ticks / 4, tails = quarter * config.pairs;
  const std::int64_t apart = higher.tail - lower.tail;
  LevelStepsReading reading{};
  reading.higher = detail::held_to_32(detail::ratio_of(higher.tail, tails));
  reading.lower = detail::held_to_32(detail::ratio_of(lower.tail, tails));
  if (reading.higher - reading.lower < 64 * 24) return reading;
  const std::int64_t R = detail::ratio_of((high * higher.bus - low * lower.bus) * 24, apart);
  reading.resistance = detail::held_to_32(R);
  const std::int64_t behind = 4 * apart - (higher.all - lower.all);
  const std::int64_t area = detail::ratio_of(behind * quarter * 32768, apart);
  reading.tau = detail::held_to_32(detail::tau_of_area(area, config.late_half_ticks));
  const std::int64_t at_legs = detail::ratio_of(high * higher.bus, tails * 4096);
  const std::int64_t in_winding = detail::ratio_of(R * reading.higher, std::int64_t{24} * 4096);
  reading.lost = detail::held_to_32(at_legs - in_winding);
  reading.usable = R > 0 && reading.tau > 0;
  return reading;
}

}  // namespace sixstep::control

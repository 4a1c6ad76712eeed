// SPDX-License-Identifier: Apache-2.0
// The realistic board of sensorless_board.hpp with comparators at its filtered terminals. The drive uses the
// edges of the comparators.
#pragma once
#include "tests/support/sensorless_board.hpp"

namespace sixstep::testing {

inline const char* word(rig::CrossingReference against) {
  return against == rig::CrossingReference::half_bus ? "half the bus" : "virtual star";
}

/// Comparators on a 3.3 V supply with an offset of 2 mV and a hysteresis of 3 mV. Both are converted to
/// voltages at the terminals before the divider.
inline rig::CrossingComparators usual_comparators(rig::CrossingReference against, double bus_V) {
  const double per_V = 1.25 * bus_V / 3.3;
  return {.against = against,
          .offset_V = {2e-3 * per_V, -2e-3 * per_V, 1e-3 * per_V},
          .hysteresis_V = 3e-3 * per_V};
}

/// Adds comparators to the board of the bench, and designs the drive for them. A low-pass filter is before
/// each comparator. Its time constant is `part_of_longest` of the longest possible one. With half the bus
/// voltage as reference, the filter must settle within half of a pulse, so the ramp ends at a fifth of the
/// no-load speed.
inline void capture_crossings(SensorlessBench& bench, rig::CrossingComparators comparators,
                              double part_of_longest = 0.8) {
  const bool half_bus = comparators.against == rig::CrossingReference::half_bus;
  if (half_bus) bench.spec.lowest_part = 0.2;
  const double part = bench.drive.chopping == control::Chopping::hard ? 0.5 : bench.spec.lowest_part;
  const double sector_s = base::sector_rad / (bench.motor.machine.pole_pairs * bench.no_load_rad_s());
  comparators.lag_s = part_of_longest * (half_bus ? part * bench.spec.period_s / 7 : sector_s / 10);
  double offset_V = 0;
  for (const double x : comparators.offset_V) offset_V = std::fmax(offset_V, std::fabs(x));
  bench.spec.comparators = {true, 1 / (2 * base::pi * comparators.lag_s), half_bus, offset_V,
                            comparators.hysteresis_V};
  const auto start = design::sensorless_start(bench.motor, bench.spec, bench.drive.current_at_full_torque_A);
  ASSERT_TRUE(start) << base::to_string(start.problems().front());
  bench.start = *start;
  bench.chip = design::sensorless_drive(bench.drive, bench.start);
  bench.board.front_end.comparators = comparators;
}

}  // namespace sixstep::testing

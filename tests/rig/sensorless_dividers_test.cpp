// SPDX-License-Identifier: Apache-2.0
// Unequal terminal dividers shift a crossing; the shift is compared with a closed form. With the threshold
// that follows from `mismatch`, the drive does not lose the rotor.
#include "tests/support/seen_crossings.hpp"

namespace SIXSTEP_TEST_FILE {

using namespace sixstep;
using namespace sixstep::testing;

constexpr double gain_error[] = {0.01, -0.006, 0.003};

/// Shift of a crossing, in electrical rad. At the crossing, the floating terminal is at U/2, and the driven
/// terminals are at U and 0 (bus voltage U). The gain errors g of the dividers change the compared voltage y
/// by U (g_f - g_high). In a sector, y falls by 4 K_e w.
double shift_rad(const SensorlessBench& bench, std::uint8_t sector, double w) {
  const std::size_t f = control::floating_leg(sector);
  const auto high = static_cast<std::size_t>(control::positive_pair(sector).source);
  const double y = bench.spec.bus_V * (gain_error[f] - gain_error[high]);
  return (sector % 2 == 0 ? y : -y) / (4 * bench.motor.machine.K_e_V_s * w) * base::sector_rad;
}

TEST(SensorlessDividers, ACrossingIsSeenBesideItsPlaceByMismatchTimesBusOverSlope) {
  SensorlessBench bench(three_motors[0]);
  bench.spec.mismatch = 0.016;
  bench.chip = design::sensorless_drive(
      bench.drive, *design::sensorless_start(bench.motor, bench.spec, bench.drive.current_at_full_torque_A));
  for (std::size_t k = 0; k < 3; ++k) bench.board.front_end.divider_gain_error[k] = gain_error[k];
  bench.setpoint(0, 0.6 * bench.no_load_rad_s());
  const SeenCrossings seen = seen_crossings(bench, 2.0, 20000);
  const double w = seen.speed_rad_s;
  const double step_rad = 2 * 30.0 / 4096 / (4 * bench.motor.machine.K_e_V_s * w) * base::sector_rad;
  for (std::uint8_t k = 0; k < 6; ++k) {
    ASSERT_GT(seen.count[k], 50);
    // The error of the mean is one step of the converter for each of the three legs.
    EXPECT_NEAR(seen.late_rad[k], shift_rad(bench, k, w), step_rad) << int(k);
  }
}

}  // namespace SIXSTEP_TEST_FILE

// SPDX-License-Identifier: Apache-2.0
// Measures the delay of the back-EMF's zero crossings that a sensorless drive detects. The delay is relative
// to the rotor's angle.
#pragma once
#include "tests/support/sensorless.hpp"

namespace sixstep::testing {

/// Mean delay of the detected crossings after the middle of each sector, in electrical rad, and their number.
struct SeenCrossings {
  double late_rad[6]{};
  int count[6]{};
  double speed_rad_s = 0.0;
};

/// Runs to `from_s`, when the drive must already run by its crossings. Then it samples `looks` control
/// periods.
inline SeenCrossings seen_crossings(const SensorlessBench& bench, double from_s, int looks = 6000) {
  SeenCrossings seen;
  auto rig = bench.rig();
  run_until(rig, from_s);
  EXPECT_EQ(phase(rig), control::SensorlessPhase::running);
  const double p = bench.motor.machine.pole_pairs, capture_Hz = bench.board.sensors.capture_Hz;
  std::uint32_t before = rig.firmware().rotor().clock.crossings.times[0];
  for (int n = 0; n < looks; ++n) {
    run_until(rig, rig.now().seconds() + bench.spec.period_s);
    const std::uint32_t at = rig.firmware().rotor().clock.crossings.times[0];
    if (at == before) continue;
    before = at;
    const auto& s = rig.plant().state();
    const auto now = static_cast<std::uint32_t>(std::fmod(rig.now().seconds() * capture_Hz, 4294967296.0));
    const double since_s = static_cast<double>(static_cast<std::uint32_t>(now - at)) / capture_Hz;
    const auto sector = static_cast<std::size_t>(rig.plant().sector());
    seen.late_rad[sector] += s.x - s.w * p * since_s - base::sector_rad / 2;
    ++seen.count[sector];
  }
  EXPECT_EQ(rig.firmware().rotor().lock.last, control::LockLoss::none);
  for (std::size_t k = 0; k < 6; ++k) seen.late_rad[k] /= seen.count[k];
  seen.speed_rad_s = rig.plant().state().w;
  return seen;
}

}  // namespace sixstep::testing

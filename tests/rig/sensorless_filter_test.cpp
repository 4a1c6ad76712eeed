// SPDX-License-Identifier: Apache-2.0
// The sensorless drive has low-pass filters on its terminals and its bus. Equal lags delay a crossing by tau.
// The lead that the design sets removes this delay from the commutation.
#include "tests/support/sensorless.hpp"

namespace SIXSTEP_TEST_FILE {

using namespace sixstep;
using namespace sixstep::testing;
using control::LockLoss;

/// A bench whose converter and timer resolve the effect of the filter. The bandwidth of the filter is 1.1
/// times the required one.
SensorlessBench bench_of(const SensorlessMotor& motor, bool filtered,
                         control::Chopping chopping = control::Chopping::soft) {
  SensorlessBench bench(motor, control::Mode::speed, chopping);
  bench.spec.lowest_part = 0.1;
  bench.spec.capture_Hz = bench.board.sensors.capture_Hz = 64e6;
  if (filtered) bench.spec.terminal_bandwidth_Hz = 1.1 * 7 / (2 * base::pi * 0.1 * bench.spec.period_s);
  const auto start = design::sensorless_start(bench.motor, bench.spec, bench.drive.current_at_full_torque_A);
  EXPECT_TRUE(start) << (start ? "" : to_string(start.problems().front()));
  bench.start = *start;
  bench.chip = design::sensorless_drive(bench.drive, bench.start);
  if (filtered) bench.board.front_end.divider_s = 1 / (2 * base::pi * bench.spec.terminal_bandwidth_Hz);
  return bench;
}

constexpr int commutations = 600;

/// Mean delay, in s, of the commutations after the end of the rotor's sector at constant speed. It is
/// negative if the commutations are early.
double mean_late_s(SensorlessBench bench, double w) {
  bench.setpoint(0, w);
  auto rig = bench.rig();
  run_until(rig, 2 * bench.start.rotor.start.align_ticks / bench.spec.capture_Hz + 1.0);
  sim::NoObserver none;
  double sum_s = 0;
  for (int n = 0; n < commutations;) {
    const sim::Instant due = rig.firmware().next_commutation(),
                       look = rig.now().plus_ticks(bench.spec.period_s * sim::ticks_per_second);
    const bool comes = rig.now() < due && due <= look;
    if (sim::run(rig, comes ? due : look, none).stop != sim::Stop::end) return 1;
    if (!comes) continue;
    const auto& s = rig.plant().state();
    sum_s +=
        (s.x > base::sector_rad / 2 ? s.x - base::sector_rad : s.x) / (bench.motor.machine.pole_pairs * s.w);
    ++n;
  }
  EXPECT_EQ(rig.firmware().rotor().lock.last, LockLoss::none);
  return sum_s / commutations;
}

/// Bound on the remaining error, in s. It has three parts:
/// - 3 % of tau, because the driven legs are sampled 3.5 tau after their edge;
/// - one count of the timer;
/// - the mean rounding of the crossings. Each crossing is rounded by one converter step up or down, while the
///   compared voltage falls by 4 K_e w in a sector.
double remainder_s(const SensorlessBench& bench, double w) {
  const double lsb_V = 1.25 * bench.spec.bus_V / 4096, K_e = bench.motor.machine.K_e_V_s;
  const double sector_s = base::sector_rad / (bench.motor.machine.pole_pairs * w);
  const double rounding_s = 2 * lsb_V / (4 * K_e * w) * sector_s;
  return 0.03 * bench.board.front_end.divider_s + 1 / bench.spec.capture_Hz +
         5 * rounding_s / std::sqrt(commutations);
}

TEST(SensorlessFilter, TheLeadTakesTheFiltersLatenessOff) {
  for (const SensorlessMotor& motor : three_motors)
    for (const double part : {0.3, 0.5, 0.8}) {
      const SensorlessBench plain = bench_of(motor, false), filtered = bench_of(motor, true);
      SensorlessBench without_lead = filtered;
      without_lead.chip.sensorless.clock.lead_ticks = 0;
      const double w = part * plain.no_load_rad_s(), tau = filtered.board.front_end.divider_s;
      const double late = mean_late_s(plain, w), most = remainder_s(filtered, w);
      EXPECT_NEAR(mean_late_s(filtered, w), late, most) << motor.name << " " << part;
      EXPECT_NEAR(mean_late_s(without_lead, w), late + tau, most) << motor.name << " " << part;
    }
}

/// Tests the slowest filter that soft chopping allows, with soft and hard chopping.
TEST(SensorlessFilter, StartsAndHoldsBehindTheSlowestFilter) {
  for (const SensorlessMotor& motor : three_motors)
    for (const control::Chopping chopping : {control::Chopping::soft, control::Chopping::hard})
      for (const double part : {0.12, -0.16, 0.3}) {
        SensorlessBench bench = bench_of(motor, true, chopping);
        bench.load_part = 0.1;
        const double w = part * bench.no_load_rad_s();
        bench.setpoint(0, w);
        auto rig = bench.rig();
        const double settled_s = 2 * bench.start.rotor.start.align_ticks / bench.spec.capture_Hz + 1.0;
        run_until(rig, settled_s);
        EXPECT_EQ(wrong_looks(rig, settled_s + 0.3, 1e-3), 0) << motor.name << " " << part;
        EXPECT_NEAR(rig.plant().state().w, w, 0.1 * std::fabs(w)) << motor.name << " " << part;
        EXPECT_EQ(rig.firmware().rotor().lock.last, LockLoss::none) << motor.name << " " << part;
      }
}

/// A leg that has just been switched off resembles a leg whose back-EMF has crossed zero. Without blanking,
/// the drive mistakes one for the other.
TEST(SensorlessFilter, WithoutItsBlankingTheRotorIsLost) {
  SensorlessBench bench = bench_of(three_motors[0], true);
  bench.chip.sensorless.crossing.margin_ticks = 0;
  bench.load_part = 0.1;
  bench.setpoint(0, 0.3 * bench.no_load_rad_s());
  auto rig = bench.rig();
  run_until(rig, 2 * bench.start.rotor.start.align_ticks / bench.spec.capture_Hz + 1.0);
  EXPECT_NE(rig.firmware().rotor().lock.last, LockLoss::none);
}

}  // namespace SIXSTEP_TEST_FILE

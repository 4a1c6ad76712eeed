// SPDX-License-Identifier: Apache-2.0
// A sensorless drive with an observer, on the bench of sensorless.hpp. The functions measure the angle errors
// of its commutations relative to the sector edge of the rotor.
#pragma once
#include "sixstep/design/loops/sensorless_observer.hpp"
#include "sixstep/design/scaling/observer_scaling.hpp"
#include "sixstep/design/scaling/scaling.hpp"
#include "tests/support/sensorless.hpp"

namespace sixstep::testing {

inline constexpr control::Follow every_follow[] = {control::Follow::crossings, control::Follow::luenberger,
                                                   control::Follow::sliding_mode, control::Follow::flux};
inline constexpr control::Follow three_observers[] = {control::Follow::luenberger,
                                                      control::Follow::sliding_mode, control::Follow::flux};

inline const char* word(control::Follow follow) {
  constexpr const char* words[] = {"crossings", "Luenberger", "sliding mode", "flux linkage", "comparators"};
  return words[static_cast<std::size_t>(follow)];
}

/// Configures the chip for an observer; motor and board are unchanged.
inline void follow(SensorlessBench& bench, control::Follow follow) {
  const auto observer = design::sensorless_observer(bench.motor, bench.spec, follow);
  ASSERT_TRUE(observer) << base::to_string(observer.problems().front());
  bench.chip.observer = observer->chip;
}

/// Angle errors of the timer's commutations, in electrical degrees after the sector edge of the rotor.
struct CommutationError {
  int count = 0;
  double sum = 0.0, squares = 0.0, worst = 0.0;
  double rms() const { return count == 0 ? 0.0 : std::sqrt(squares / count); }
  double mean() const { return count == 0 ? 0.0 : sum / count; }
};

/// Continues the run to `to_s` and measures the error at each compare match. `forward`: true if the rotor
/// turns forward.
template <class Rig>
CommutationError watch_commutations(Rig& rig, double to_s, double period_s, bool forward = true) {
  CommutationError error;
  sim::NoObserver none;
  const auto run = [&](const sim::Instant& at) { ASSERT_EQ(sim::run(rig, at, none).stop, sim::Stop::end); };
  while (rig.now().seconds() < to_s) {
    const sim::Instant look = rig.now().plus_ticks(period_s / 40 * sim::ticks_per_second);
    const sim::Instant next = rig.firmware().next_commutation();
    if (!(next < look) || next < rig.now()) {
      run(look);
      continue;
    }
    const std::int32_t before = rig.firmware().rotor().position.sectors;
    run(next);
    const double deg = rig.plant().sector() * 60.0 + rig.plant().state().x * 180.0 / base::pi;
    run(next.plus_ticks(1000));  // 1 ns
    if (rig.firmware().rotor().position.sectors == before) continue;
    const int into = rig.firmware().rotor().sector;
    const double late = std::remainder(forward ? deg - 60.0 * into : 60.0 * (into + 1) - deg, 360.0);
    ++error.count;
    error.sum += late;
    error.squares += late * late;
    error.worst = std::fmax(error.worst, std::fabs(late));
  }
  return error;
}

/// Returns the same drive in fixed point and gives the board the same bases.
template <class Scalar>
control::SensorlessDriveConfig<Scalar> in_fixed_point(SensorlessBench& bench) {
  const control::SensorlessDriveConfig<double>& d = bench.chip;
  const double most_A = 2.0 * bench.drive.current_limit_A, full = 1.25 * bench.spec.bus_V;
  const auto scaled = design::scaled<Scalar>(d.drive, {.current_A = most_A,
                                                       .speed_rad_s = 1.2 * bench.no_load_rad_s(),
                                                       .position_deg = 0.0,
                                                       .bus_V = full,
                                                       .setpoint = bench.no_load_rad_s()});
  EXPECT_TRUE(scaled) << (scaled ? "" : base::to_string(scaled.problems().front()));
  const design::Bases& b = scaled->bases;
  bench.board.bases = {b.current_A, b.voltage_V, b.speed_rad_s, b.position_deg,
                       design::setpoint_base(d.drive.mode, b)};
  control::SensorlessDriveConfig<Scalar> c;
  c.drive = scaled->config;
  c.source = d.source;
  const control::SensorlessConfig<double>& from = d.sensorless;
  c.sensorless.crossing = from.crossing;
  c.sensorless.captured = from.captured;
  c.sensorless.clock = from.clock;
  c.sensorless.spin = from.spin;
  c.sensorless.lock = from.lock;
  const control::StartUpConfig<double>& s = from.start;
  c.sensorless.start = {Scalar(s.current_A / b.current_A),
                        Scalar(s.falling_A / b.current_A),
                        s.align_ticks,
                        s.swing_shift,
                        s.swing_threshold,
                        s.first_speed,
                        s.acceleration,
                        s.jerk,
                        s.last_speed,
                        s.longest_ticks,
                        s.trusted,
                        s.trusted_ticks};
  c.sensorless.speed = {control::TickRatio<Scalar>(from.speed.sector_rad_s_ticks / b.speed_rad_s),
                        from.speed.timeout_ticks, from.speed.edges, from.speed.window_ticks,
                        from.speed.grain_ticks};
  c.observer = design::observer_in<Scalar>(d.observer, b);
  c.start_output = Scalar(d.start_output);
  c.duty.step = control::Accumulator<Scalar>(d.duty.step);
  c.current.step = control::Accumulator<Scalar>(d.current.step / b.current_A);
  c.least_duty = Scalar(d.least_duty);
  return c;
}

}  // namespace sixstep::testing

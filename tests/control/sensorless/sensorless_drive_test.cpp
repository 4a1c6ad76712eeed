// SPDX-License-Identifier: Apache-2.0
// The whole drive in every arithmetic. The motion of the rotor is prescribed, so all formats have the same
// counts. Their commands are equal, except for the rounding of currents and speeds.
#include "sixstep/control/sensorless/sensorless_drive.hpp"

#include <gtest/gtest.h>

#include <type_traits>
#include <vector>

#include "tests/control/sensorless/terminals.hpp"

namespace SIXSTEP_TEST_FILE {

using namespace sixstep::control;
using namespace sixstep::testing;

static_assert(std::is_trivially_copyable_v<SensorlessDriveState<double>>);
static_assert(std::is_trivially_copyable_v<SensorlessDriveState<Q15>>);

constexpr std::uint32_t tick = 500;  // timer counts per control period

/// The bases are 10 A, 25 V and 1000 rad/s. The gains are arbitrary, because the motion of the rotor is
/// prescribed.
template <class Scalar>
SensorlessDriveConfig<Scalar> chip() {
  SensorlessDriveConfig<Scalar> c;
  c.drive.mode = Mode::duty;
  c.drive.nominal_bus_V = Divisor<Scalar>(0.96);
  c.drive.current.d1 = Gain<Scalar>(0.5);
  c.drive.current.limit = Scalar(0.96);
  c.sensorless.crossing = {.rail_counts = 60, .threshold = 12, .below = 12};
  c.sensorless.spin = {.threshold = 12, .crossings = 4, .settle_ticks = 1000, .listen_ticks = 100000};
  auto& start = c.sensorless.start;
  start.current_A = Scalar(0.2);
  start.falling_A = Scalar(0.05);
  start.align_ticks = 20000;
  start.first_speed = 1u << 26;
  start.acceleration = 1u << 20;
  start.last_speed = 1u << 28;
  start.longest_ticks = 400000;
  start.trusted = 4;
  start.trusted_ticks = 40000;
  c.sensorless.lock.longest_ticks = 80000;
  c.sensorless.speed = {TickRatio<Scalar>(0.13 * 16000), 400000, 6, 0, 1};
  c.duty.step = Accumulator<Scalar>(0.01);
  c.least_duty = Scalar(0.02);
  return c;
}

struct Seen {
  SensorlessPhase phase;
  std::uint8_t sector;
  std::uint32_t next;
  bool enabled;
  bool operator==(const Seen&) const = default;
};

/// A rotor that turns when half of the full duty is requested. It is blocked from tick 900 to tick 1200, and
/// then turns again.
template <class Scalar>
std::vector<Seen> ridden(double sense) {
  const SensorlessDriveConfig<Scalar> config = chip<Scalar>();
  SensorlessDriveState<Scalar> state;
  Telemetry<Scalar> telemetry;
  std::vector<Seen> seen;
  const double T = 8000;
  double deg = 17;
  for (std::uint32_t n = 0; n < 3000; ++n) {
    const std::uint32_t now = n * tick;
    const bool blocked = n > 900 && n < 1200;
    std::uint32_t at = 0;
    if (next_commutation(state, at) && !comes_before(now, at)) sensorless_drive_commutate(config, state, at);
    const double emf = blocked ? 0.0 : sense * 700;
    SensorlessDriveInput<Scalar> input;
    input.terminals = state.drive.command.enabled ? driven_sample(state.sensorless.sector, deg, emf, now)
                                                  : coasting_sample(deg, emf, now);
    input.on = state.drive.command.enabled;
    sensorless_drive_step(config, state, input, {Scalar(0.5 * sense)}, telemetry);
    seen.push_back({state.sensorless.phase, state.sensorless.sector, state.sensorless.clock.next,
                    state.drive.command.enabled});
    if (!blocked) deg += sense * 60 * tick / T;
    if (state.sensorless.phase == SensorlessPhase::running && !blocked && (n < 900 || n > 1600)) {
      const int rotor = static_cast<int>(std::floor(deg / 60)),
                off = ((rotor - state.sensorless.sector) % 6 + 6) % 6;
      EXPECT_TRUE(off == 0 || off == 1 || off == 5) << n;
      EXPECT_NEAR(static_cast<double>(sensorless_speed(config.sensorless, state.sensorless, now)),
                  sense * 0.13 * 16000 / T, 0.01)
          << n;
    }
  }
  return seen;
}

TEST(SensorlessDrive, CatchesLosesAndCatchesAgainAlikeInEveryArithmetic) {
  for (const double sense : {1.0, -1.0}) {
    const std::vector<Seen> reference = ridden<double>(sense);
    EXPECT_EQ(reference[800].phase, SensorlessPhase::running);
    EXPECT_NE(reference[960].phase, SensorlessPhase::running)
        << "blocked at 900: lost within two sectors of 16 ticks";
    EXPECT_EQ(reference[2999].phase, SensorlessPhase::running);
    EXPECT_TRUE(ridden<float>(sense) == reference);
    EXPECT_TRUE(ridden<Q15>(sense) == reference);
    EXPECT_TRUE(ridden<Q14>(sense) == reference);
    EXPECT_TRUE(ridden<Q31>(sense) == reference);
    EXPECT_TRUE(ridden<Q30>(sense) == reference);
  }
}

TEST(SensorlessDrive, TheDefaultNeverDrives) {
  const SensorlessDriveConfig<double> config;
  SensorlessDriveState<double> state;
  Telemetry<double> telemetry;
  for (std::uint32_t n = 0; n < 200; ++n) {
    SensorlessDriveInput<double> input;
    input.terminals = coasting_sample(n, 700, n * tick);
    EXPECT_FALSE(sensorless_drive_step(config, state, input, {1.0}, telemetry).enabled);
  }
}

/// After the ramp, the duty continues without a jump. Then it changes by a fixed step per tick.
TEST(SensorlessDrive, ApproachesADutyFromWhereTheStartLeavesIt) {
  const SensorlessDriveConfig<double> config = chip<double>();
  SensorlessDriveState<double> state;
  state.drive.command.duty = 0.3;
  detail::hand_over(config, state, Measurement<double>{}, 0.5, true, false);
  EXPECT_DOUBLE_EQ(detail::approached(config, state, 0.5), 0.31);
  EXPECT_DOUBLE_EQ(detail::approached(config, state, 0.5), 0.32);
  detail::hand_over(config, state, Measurement<double>{}, 0.5, true, true);
  EXPECT_DOUBLE_EQ(detail::approached(config, state, 0.5), 0.01) << "caught: nothing flows yet";
}

}  // namespace SIXSTEP_TEST_FILE

// SPDX-License-Identifier: Apache-2.0
// Low-side shunts on the virtual board. A shunt shows its leg's current exactly while the leg is connected below, and
// 0 otherwise. Whenever the drive counts a sample, the sample is the phase current. Six-step with every chopping and
// pattern, and three legs with space vector modulation.
#include <gtest/gtest.h>

#include <bit>
#include <cmath>

#include "sixstep/control/three_phase_pwm.hpp"
#include "tests/support/three_leg_firmware.hpp"

namespace SIXSTEP_TEST_FILE {

using namespace sixstep;
using namespace sixstep::testing;
using control::Chopping;

constexpr double T = 30e-6;

/// The samples of one tick.
struct Seen {
  rig::Sample sample;
  plant::PerLeg<double> true_A{}, above_A{};
  plant::Legs legs{};
};

template <class Real>
Seen seen_at(const rig::SampleInstant<Real>& instant) {
  Seen seen{.sample = rig::sample_of(instant), .legs = instant.legs};
  for (std::size_t k = 0; k < 3; ++k) seen.true_A[k] = static_cast<double>(instant.state.i[k]);
  return seen;
}

/// A six-step drive with converters, which stores the samples of its last tick.
struct Sampling : rig::SensedDrive<double> {
  using SensedDrive::SensedDrive;
  Seen seen{};
  template <class Real>
  control::BridgeCommand<double> tick(const rig::SampleInstant<Real>& instant, double setpoint) {
    seen = seen_at(instant);
    return SensedDrive::tick(instant, setpoint);
  }
  bool open_loop() const { return false; }  ///< it samples although its constant duty needs no sample
};

/// Calls look() after each tick.
template <class Look>
struct AfterTicks {
  Look look;
  template <class Rig>
  void segment(const Rig& rig, double) {
    if (rig.ticked()) look(rig.firmware().seen);
  }
  template <class Rig>
  bool done(const Rig&) {
    return false;
  }
};
template <class Look>
AfterTicks(Look) -> AfterTicks<Look>;

void expect_path(const Seen& seen) {
  double below = 0.0;
  for (std::size_t k = 0; k < 3; ++k) {
    const bool low = plant::is_low(seen.legs[k]);
    EXPECT_EQ(seen.sample.i_A[k], low ? seen.true_A[k] : 0.0) << k;
    if (low) below += seen.true_A[k];
  }
  // A shunt in the bus's return carries the current of all legs below, which is that in the positive rail.
  EXPECT_NEAR(seen.sample.dc_link_A, -below, 1e-12);
}

void expect_exact(const Seen& seen) {
  for (std::size_t k = 0; k < 3; ++k)
    if ((seen.sample.low_side.shown >> k & 1) != 0) {
      EXPECT_EQ(seen.sample.i_A[k], seen.true_A[k]) << k;
    }
}

struct Case {
  Chopping chopping;
  control::PwmPattern pattern;
  bool centre, middle;
  double duty, dead_s;
};

std::ostream& operator<<(std::ostream& out, const Case& c) {
  return out << int(c.chopping) << " pattern " << int(c.pattern) << (c.centre ? " centre" : " edge")
             << (c.middle ? " middle " : " start ") << c.duty;
}

constexpr double settle_s = 1e-6;

Board six_step(const Case& c) {
  Board b = Board::duty(c.duty, c.chopping);
  b.drive.extras.on = true;
  b.drive.extras.pwm = {c.pattern, control::Gain<double>(0.0)};
  b.devices = {.R_on_ohm = 0.01, .V_f_V = 0.7, .r_d_ohm = 0.02};
  b.board.commutate_at_sample = true;
  b.board.sampled_in_middle = c.middle;
  b.board.modulator.centre_aligned = c.centre;
  b.board.modulator.dead_ticks = c.dead_s * 1e12;
  b.board.sensors.currents = rig::CurrentMeasurement::low_side;
  b.board.sensors.current = {.bits = 16, .range = 50.0};
  const double late = (settle_s + c.dead_s) / T;
  control::LowSideConfig<double>& window = b.board.sensors.low_side;
  window.shunts = 7;
  if (c.middle) {
    window.greatest_duty = c.centre ? 0.0 : 0.5 - late;
    window.least_duty = c.centre ? 2 * late : 0.5;
  } else {
    window.greatest_duty = c.centre ? 1 - 2 * late : 1 - late;
  }
  return b;
}

TEST(LowSideShunts, ASixStepSampleThatCountsIsThePhaseCurrent) {
  int counted = 0, hidden = 0;
  for (const Chopping chopping : {Chopping::soft, Chopping::complementary, Chopping::hard})
    for (const auto pattern : {control::PwmPattern::upper, control::PwmPattern::lower})
      for (const bool centre : {false, true})
        for (const bool middle : {false, true})
          for (const double duty : {0.04, 0.3, 0.6, 0.95, 1.0, -0.6}) {
            if (chopping == Chopping::hard && (pattern != control::PwmPattern::upper || duty < 0.6)) continue;
            const Case c{chopping, pattern, centre,
                         middle,   duty,    chopping == Chopping::complementary ? 0.5e-6 : 0.0};
            SCOPED_TRACE(::testing::Message() << c);
            const Board b = six_step(c);
            rig::Rig<double, Sampling> rig(b.plant(), b.drive, b.board, b.timeline);
            AfterTicks watch{[&](const Seen& seen) {
              expect_path(seen);
              expect_exact(seen);
              if (!seen.sample.low_side.on) return;
              const bool any = seen.sample.low_side.shown != 0;
              ++(any ? counted : hidden);
            }};
            ASSERT_EQ(run_to(rig, 12e-3, watch), sim::Stop::end);
            EXPECT_EQ(rig.fault(), rig::Fault::none);
          }
  EXPECT_GT(counted, 1000);
  EXPECT_GT(hidden, 1000);
}

/// Freewheeling through the upper switch and the other upper diode: no shunt carries the motor current.
TEST(LowSideShunts, ACurrentThatFreewheelsAboveIsNotSeen) {
  const Board b = six_step({Chopping::soft, control::PwmPattern::lower, true, false, 0.6, 0.0});
  rig::Rig<double, Sampling> rig(b.plant(), b.drive, b.board, b.timeline);
  double largest_A = 0.0;
  int ticks = 0;
  AfterTicks watch{[&](const Seen& seen) {
    if (rig.now().seconds() < 1e-3) return;
    largest_A = std::max({largest_A, std::fabs(seen.true_A[0]), std::fabs(seen.true_A[1])});
    EXPECT_EQ(seen.sample.low_side.shown, 0);
    ++ticks;
  }};
  ASSERT_EQ(run_to(rig, 2e-3, watch), sim::Stop::end);
  EXPECT_GT(largest_A, 1.0);
  const rig::Diagnosis found = rig.firmware().diagnosis();
  EXPECT_EQ(found.blind_samples, found.shunt_samples);
  EXPECT_GT(ticks, 30);
}

/// Space vector modulation of a turning voltage, from a chip with converters.
struct TurningLegs {
  double modulation = 0.0, rad_s = 0.0;
  Seen seen{};
  rig::Registers inputs{};

  control::LegCommands<double> legs(double t_s) const {
    const double v = modulation / std::sqrt(3.0), x = rad_s * t_s, third = 2 * base::pi / 3;
    return control::space_vector(
        control::Abc<double>{v * std::cos(x), v * std::cos(x - third), v * std::cos(x + third)}, 1.0);
  }
};

class TurningFirmware {
 public:
  using Number = double;
  using Config = TurningLegs;
  using Command = control::LegCommands<double>;
  static constexpr bool fault_ends_run = true;
  TurningFirmware(const Config& config, const rig::BoardConfig&, const rig::PowerUp&) : config_(config) {}

  template <class Real>
  Command tick(const rig::SampleInstant<Real>& instant, double) {
    seen = seen_at(instant);
    return config_.legs(instant.at.seconds());
  }
  void captured(std::uint8_t, const sim::Instant&) {}
  void retune(const rig::Tuning<Config>&) {}
  void request_run(bool) {}
  void request_clear() {}
  bool open_loop() const { return false; }
  bool follows_setpoint_at_once() const { return false; }
  rig::Registers& registers() { return config_.inputs; }
  rig::Diagnosis diagnosis() const { return {}; }
  Seen seen{};

 private:
  Config config_;
};

/// A locked rotor's currents follow the turning voltage. The sample at a period's start is the middle of the lower
/// switches' on-time.
TEST(LowSideShunts, ThreeLegsAreShownUpToTheWindowAndExact) {
  constexpr double dead_s = 0.5e-6, late = (settle_s + dead_s) / T, limit = 1 - 2 * late;
  for (const double modulation : {0.2, 0.8, 0.85, 0.95, 1.0}) {
    Board b;
    b.shaft.locked = true;
    b.devices = {.R_on_ohm = 0.01, .V_f_V = 0.7, .r_d_ohm = 0.02};
    b.board.modulator.centre_aligned = true;
    b.board.modulator.dead_ticks = dead_s * 1e12;
    b.board.sensors.low_side = {.shunts = 7, .greatest_duty = limit};
    const TurningLegs legs{.modulation = modulation, .rad_s = 2 * base::pi / 9.99e-3};
    rig::Rig<double, TurningFirmware> rig(b.plant(), legs, b.board, b.timeline);
    double before_s = -1;
    int ticks = 0;
    AfterTicks watch{[&](const Seen& seen) {
      expect_path(seen);
      expect_exact(seen);
      if (before_s >= 0) {  // the command in effect is that of the tick before
        const auto in_effect = legs.legs(before_s);
        for (std::size_t k = 0; k < 3; ++k)
          EXPECT_EQ((seen.sample.low_side.shown >> k & 1), in_effect.leg[k].duty <= limit ? 1 : 0);
        ++ticks;
      }
      before_s = rig.now().seconds();
    }};
    ASSERT_EQ(run_to(rig, 20e-3, watch), sim::Stop::end);
    EXPECT_GT(ticks, 600);
  }
}

}  // namespace SIXSTEP_TEST_FILE

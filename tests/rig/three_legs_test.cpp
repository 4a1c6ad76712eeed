// SPDX-License-Identifier: Apache-2.0
// Firmware on the virtual board commands three legs. Circuits are compared with closed forms. Six-step as
// three leg commands is compared with six-step.
#include <gtest/gtest.h>

#include "tests/support/laws.hpp"
#include "tests/support/three_leg_firmware.hpp"

namespace SIXSTEP_TEST_FILE {

using namespace sixstep;
using namespace sixstep::testing;
using control::Chopping;

constexpr double T = 30e-6, U = 24.0;

Board locked_at(double electrical_deg) {
  Board b;
  b.shaft.locked = true;
  b.start.angle_rad = at_electrical_deg(electrical_deg);
  return b;
}

template <class Rig>
void expect_same_state(const Rig& one, const auto& two) {
  for (int k = 0; k < 3; ++k) EXPECT_EQ(one.plant().state().i[k], two.plant().state().i[k]);
  EXPECT_EQ(one.plant().state().w, two.plant().state().w);
  EXPECT_EQ(one.plant().state().x, two.plant().state().x);
  EXPECT_EQ(one.event_count(rig::EventKind::pwm_edge), two.event_count(rig::EventKind::pwm_edge));
}

/// A firmware that converts the six-step command of the present sector's pair into three leg commands.
struct SixStepLegs {
  Chopping chopping;

  template <class Real>
  control::LegCommands<double> operator()(const rig::SampleInstant<Real>& instant, double duty) const {
    const control::Pair pair = control::positive_pair(control::sector_of_hall(instant.pins));
    return as_legs(
        control::BridgeCommand<double>{.enabled = true, .pair = pair, .duty = duty, .chopping = chopping});
  }
};

/// The rotor accelerates from rest, with commutation at the sample. Six-step as three leg commands has the
/// same bits as six-step, including the freewheeling of floating legs.
TEST(ThreeLegs, SixStepAsThreeLegsHasTheBitsOfSixStep) {
  for (const Chopping chopping : {Chopping::soft, Chopping::hard, Chopping::complementary})
    for (const bool centred : {false, true})
      for (const double minimum : {0.0, 0.2}) {
        SCOPED_TRACE(::testing::Message() << int(chopping) << centred << minimum);
        Board b = Board::duty(0.8, chopping);
        b.setpoint(5'000'000'000, 0.15);
        b.board.commutate_at_sample = true;
        b.board.modulator.centre_aligned = centred;
        b.board.modulator.minimum_pulse_ticks = minimum * 30e6;
        b.devices = {.R_on_ohm = 0.01, .V_f_V = 0.7, .r_d_ohm = 0.02};
        auto six = b.rig();
        auto three = three_leg_rig(b, SixStepLegs{chopping});
        LawChecker<double> laws;
        ASSERT_EQ(run_to(six, 8e-3), sim::Stop::end);
        ASSERT_EQ(run_to(three, 8e-3, laws), sim::Stop::end);
        laws.expect_all();
        EXPECT_GT(three.event_count(rig::EventKind::sector_edge), 3);
        expect_same_state(six, three);
      }
}

/// The exact mean of i_a over whole periods, computed from the integrals of its polynomials.
struct MeanOfA {
  double ampere_s = 0.0, s = 0.0;
  void segment(const auto& rig, double part) {
    const plant::Expansion<double>& y = rig.plant().expansion();
    double power = part;
    for (int j = 0; j <= y.degree; ++j, power *= part) ampere_s += y.h * y.i[0][j] * power / (j + 1);
    s += y.h * part;
  }
};

/// The mean of i_a in the steady state, over a hundred periods. They begin after 40 time constants, when the
/// initial transient has decayed below rounding.
double mean_of_a(const Board& b, const control::LegCommands<double>& legs) {
  auto rig = three_leg_rig(b, HeldLegs{legs});
  EXPECT_EQ(run_to(rig, 800 * T), sim::Stop::end);
  MeanOfA mean;
  EXPECT_EQ(run_to(rig, 900 * T, mean), sim::Stop::end);
  EXPECT_NEAR(mean.s, 100 * T, 1e-15);
  return mean.ampere_s / mean.s;
}

/// The solver's error of currents is 6.5e-12 of full scale (model.md 12). Full scale is 23.3 A.
constexpr double amp_tolerance = 6.5e-12 * 23.3;

TEST(ThreeLegs, TheMeanVoltageOfEachLegIsItsDuty) {
  for (const bool centred : {false, true}) {
    Board b = locked_at(10.0);
    b.board.modulator.centre_aligned = centred;
    const double u_a = 0.7 * U, u_b = 0.4 * U, u_c = 0.25 * U;
    EXPECT_NEAR(mean_of_a(b, complementary(0.7, 0.4, 0.25)), (u_a - (u_a + u_b + u_c) / 3) / b.machine.R_ohm,
                amp_tolerance);
  }
}

/// During the dead time, a diode conducts: the lower diode if the current i flows into the motor, else the
/// upper diode. The leg's mean voltage falls by U t_d/T if i > 0 (bus voltage U, dead time t_d, period T). It
/// rises by the same amount if i < 0. Both changes are independent of the duty.
TEST(ThreeLegs, DeadTimeWorksAgainstTheCurrentOfEachLeg) {
  const double dead_s = 1e-6, lost = U * dead_s / T;
  for (const bool centred : {false, true})
    for (const double sign : {1.0, -1.0}) {
      SCOPED_TRACE(::testing::Message() << centred << sign);
      Board b = locked_at(10.0);
      b.board.modulator.centre_aligned = centred;
      b.board.modulator.dead_ticks = dead_s * 1e12;
      // The currents are some amperes in each direction. They exceed the ripple of U T/(8 L_s) = 0.3 A.
      const double d = sign * 0.15;
      const double u_a = (0.5 + d) * U - sign * lost, u_bc = (0.5 - d) * U + sign * lost;
      EXPECT_NEAR(mean_of_a(b, complementary(0.5 + d, 0.5 - d, 0.5 - d)),
                  (u_a - (u_a + 2 * u_bc) / 3) / b.machine.R_ohm, amp_tolerance);
    }
}

TEST(ThreeLegs, PulsesBelowTheMinimumChangeTheMeanVoltageAndNoOtherLegs) {
  Board b = locked_at(10.0);
  b.board.modulator.minimum_pulse_ticks = 1.5e6;  // 5 %
  const double u_a = U, u_b = 0.5 * U, u_c = 0.0;
  EXPECT_NEAR(mean_of_a(b, complementary(0.96, 0.5, 0.04)), (u_a - (u_a + u_b + u_c) / 3) / b.machine.R_ohm,
              amp_tolerance);
}

/// Two legs are driven. The third leg is off and floats. The voltage across both phases is (d_a - d_b) U
/// (duties d, bus voltage U), and no current flows in c. At rest, the terminal of c is between the rails.
TEST(ThreeLegs, ALegThatIsOffFloatsAndCarriesNothing) {
  Board b = locked_at(10.0);
  control::LegCommands<double> legs = complementary(0.6, 0.35, 0.0);
  legs.leg[2] = {};
  EXPECT_NEAR(mean_of_a(b, legs), 0.25 * U / b.R_tt(), amp_tolerance);
  auto rig = three_leg_rig(b, HeldLegs{legs});
  ASSERT_EQ(run_to(rig, 20 * T), sim::Stop::end);
  EXPECT_EQ(rig.plant().state().i[2], 0.0);
}

/// A firmware that drives for ten periods, and then turns off.
struct TenPeriods {
  template <class Real>
  control::LegCommands<double> operator()(const rig::SampleInstant<Real>& instant, double) const {
    return instant.number < 10 ? complementary(0.9, 0.1, 0.5) : control::LegCommands<double>{};
  }
};

/// After all legs turn off, the currents flow through the diodes until they are zero. The voltage across both
/// phases is then L di/dt = -U (bus voltage U).
TEST(ThreeLegs, TurningOffLetsTheCurrentsEndInTheDiodes) {
  Board b = locked_at(10.0);
  auto rig = three_leg_rig(b, TenPeriods{});
  ASSERT_EQ(run_to(rig, 10 * T), sim::Stop::end);
  EXPECT_GT(rig.plant().state().i[0], 5.0);
  ASSERT_EQ(run_to(rig, 40 * T), sim::Stop::end);
  EXPECT_EQ(rig.plant().gates(), plant::Gates{});
  for (int k = 0; k < 3; ++k) EXPECT_EQ(rig.plant().state().i[k], 0.0);
}

/// By model.md 11, each leg of a board with a delay has the duty 1/2 in period 0. A firmware that is off
/// remains off.
TEST(ThreeLegs, PeriodZeroOfADelayedBoardHasNoVoltage) {
  Board b = locked_at(10.0);
  b.board.delayed = true;
  b.board.modulator.centre_aligned = true;
  auto rig = three_leg_rig(b, HeldLegs{complementary(0.9, 0.1, 0.1)});
  ASSERT_EQ(run_to(rig, 0.26 * T), sim::Stop::end);
  EXPECT_EQ(rig.plant().gates(), gates({true, true, true}, {}));
  ASSERT_EQ(run_to(rig, T), sim::Stop::end);
  EXPECT_EQ(rig.event_count(rig::EventKind::pwm_edge), 2);
  for (int k = 0; k < 3; ++k) EXPECT_EQ(rig.plant().state().i[k], 0.0);
  ASSERT_EQ(run_to(rig, 2 * T), sim::Stop::end);
  EXPECT_GT(rig.plant().state().i[0], 1.0);

  auto silent = three_leg_rig(b, HeldLegs{});
  ASSERT_EQ(run_to(silent, 3 * T), sim::Stop::end);
  EXPECT_EQ(silent.event_count(rig::EventKind::pwm_edge), 0);
}

/// The sample is in the middle of a period. Its command acts from the start of the next period.
TEST(ThreeLegs, AnAnswerFromTheMiddleActsFromTheNextPeriod) {
  Board b = locked_at(10.0);
  b.board.sampled_in_middle = true;
  auto rig = three_leg_rig(b, HeldLegs{complementary(1.0, 0.0, 0.0)});
  ASSERT_EQ(run_to(rig, 0.99 * T), sim::Stop::end);
  EXPECT_EQ(rig.plant().gates(), plant::Gates{});
  ASSERT_EQ(run_to(rig, 1.01 * T), sim::Stop::end);
  EXPECT_EQ(rig.plant().gates(), gates({true, false, false}, {false, true, true}));
}

}  // namespace SIXSTEP_TEST_FILE

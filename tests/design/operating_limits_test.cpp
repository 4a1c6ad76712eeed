// SPDX-License-Identifier: Apache-2.0
// Limits and ripple are compared with closed forms. (tests/analysis/design_study_test.cpp compares the ripple
// with the exact simulation.)
#include "sixstep/design/loops/operating_limits.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "sixstep/control/leg_command.hpp"
#include "sixstep/plant/back_emf.hpp"

namespace SIXSTEP_TEST_FILE {

using namespace sixstep;
using namespace sixstep::design;

constexpr double eps = 0x1p-52;

MotorModel thesis_motor() {
  MotorModel m;
  m.machine = {.R_ohm = 0.515, .L_H = 0.286e-3, .K_e_V_s = 0.01675, .pole_pairs = 8};
  m.K_t_Nm_A = 0.0335;
  return m;
}

TEST(Ripple, IsTheSteadyStateOfTwoExponentials) {
  const MotorModel m = thesis_motor();
  const double R = 1.03, L = 0.572e-3, T = 30e-6;
  for (const double d : {0.01, 0.215, 0.5, 0.9}) {
    for (const double e : {0.0, 3.0}) {  // the EMF cancels
      const double on = std::exp(-R * d * T / L), off = std::exp(-R * (1 - d) * T / L);
      // While the voltage is on, the current approaches (U - e)/R; while it is off, -e/R. Therefore lowest =
      // off highest - (1 - off) e/R.
      const double highest = ((1 - on) * (24 - e) / R - on * (1 - off) * e / R) / (1 - on * off);
      const double lowest = off * highest - (1 - off) * e / R;
      EXPECT_NEAR(current_ripple_A(m, 24.0, T, control::Chopping::soft, d), highest - lowest, 1e-12);
    }
  }
  // According to model.md 13, the ripple is 0.21 A at 5 A. The duty is d = 5 R/24, and the rotor is locked.
  EXPECT_NEAR(current_ripple_A(m, 24.0, T, control::Chopping::soft, 5 * R / 24), 0.21, 0.005);
}

TEST(Ripple, IsWorstAtHalfDutyAndTwiceAsLargeInHardChopping) {
  const MotorModel m = thesis_motor();
  const Ripple worst = worst_ripple(m, 24.0, 30e-6, control::Chopping::soft);
  for (double d = 0.0; d <= 1.0; d += 1.0 / 64)
    EXPECT_LE(current_ripple_A(m, 24.0, 30e-6, control::Chopping::soft, d), worst.worst_A * (1 + 8 * eps));
  EXPECT_NEAR(worst_ripple(m, 24.0, 30e-6, control::Chopping::hard).worst_A, 2 * worst.worst_A, 4 * eps);
  EXPECT_NEAR(worst.worst_A, 24 / 1.03 * std::tanh(30e-6 * 1.03 / 0.572e-3 / 4), 1e-14);
  EXPECT_NEAR(period_for_ripple_s(m, 24.0, control::Chopping::soft, worst.worst_A), 30e-6, 1e-18);
  EXPECT_TRUE(std::isinf(period_for_ripple_s(m, 24.0, control::Chopping::soft, 24.0)));
}

/// A leg's terminal voltage, divided by the bus voltage. If both switches are off, a diode conducts: the
/// lower diode in the source leg, the upper diode in the sink leg.
double terminal(control::LegSide side, bool source) {
  if (side == control::LegSide::high) return 1.0;
  if (side == control::LegSide::low) return 0.0;
  return source ? 0.0 : 1.0;
}

/// Mean of the pair's voltage over a period while a current flows. It is computed from the timer's states of
/// the two legs.
double mean_voltage(control::Chopping chopping, control::ChoppedSwitch chopped, double duty) {
  const auto mean = [&](const control::LegCommand<double>& leg, bool source) {
    const control::LegSides sides = control::sides_of(leg);
    const double d = leg.state == control::LegState::pwm ? leg.duty : 1.0;
    return d * terminal(sides.pulse, source) + (1 - d) * terminal(sides.rest, source);
  };
  return mean(control::source_leg(chopping, chopped, duty), true) -
         mean(control::sink_leg(chopping, chopped, duty), false);
}

TEST(VoltsPerDuty, AreWhatTheTimersLegsMakeOfADuty) {
  using control::Chopping;
  for (const Chopping chopping : {Chopping::soft, Chopping::hard, Chopping::complementary})
    for (const auto chopped : {control::ChoppedSwitch::upper, control::ChoppedSwitch::lower}) {
      const double low = mean_voltage(chopping, chopped, 0.25), high = mean_voltage(chopping, chopped, 0.75);
      EXPECT_EQ((high - low) / 0.5, volts_per_duty(chopping));
      EXPECT_EQ(duty_for_voltage(chopping, low), 0.25);
      EXPECT_EQ(duty_for_voltage(chopping, high), 0.75);
    }
}

TEST(Headroom, EndsWhereTheBusIsUsedUp) {
  const MotorModel m = thesis_motor();
  const double end = speed_for_current_rad_s(m, 24.0, 2.33);
  EXPECT_NEAR(headroom_V(m, 24.0, 2.33, end), 0.0, 24 * 4 * eps);
  EXPECT_NEAR(end, (24 - 1.03 * 2.33) / 0.0335, 1e-9);
  EXPECT_NEAR(soft_braking_limit_rad_s(m, 2.33), 2.33 / 0.0335 * 1.03, 1e-12);
}

/// At the limit, the whole bus voltage just keeps the staying phase's current constant. The equations of the
/// star, with the plant's shapes, are L di/dt = v_k - e_k - R i_k - v_star (symbols of model.md). The leaving
/// leg is at the same rail as the staying leg.
TEST(CommutationLimit, IsTheSpeedAtWhichAWholeDutyHoldsTheStayingCurrent) {
  const auto rate = [](const MotorModel& m, double bus_V, double i, double w) {
    const plant::Machine& x = m.machine;
    const auto table = x.back_emf == plant::BackEmf::sine ? plant::sine_table<double>()
                                                          : plant::trapezoid_table<double>(x.flat_deg);
    const auto& shape = table[1].piece[0].alpha;  // sector 1 begins in the middle of phase a's top
    double e[3], mean = 0.0;
    for (int k = 0; k < 3; ++k) mean += (e[k] = x.K_e_V_s * w * shape[k]) / 3;
    const double star = (2 * bus_V + 0.0) / 3 - mean;  // staying and leaving leg are at the bus voltage, the
                                                       // entering leg at 0
    return bus_V - e[0] - x.R_ohm * i - star;
  };
  for (const double flat_deg : {0.0, 60.0, 100.0, 120.0, 150.0}) {
    MotorModel m = thesis_motor();
    if (flat_deg == 0.0) m.machine.back_emf = plant::BackEmf::sine;
    m.machine.flat_deg = flat_deg;
    for (const double i : {0.5, 3.0, 10.0}) {
      const double w = commutation_limit_rad_s(m, 24.0, i);
      EXPECT_NEAR(rate(m, 24.0, i, w), 0.0, 24 * 16 * eps) << flat_deg << " deg, " << i << " A";
      EXPECT_GT(rate(m, 24.0, i, 0.99 * w), 0.0);
      EXPECT_LT(rate(m, 24.0, i, 1.01 * w), 0.0);
    }
    EXPECT_EQ(commutation_limit_rad_s(m, 24.0, 16.0), 0.0);  // 3 R i alone exceeds the bus voltage
  }
}

}  // namespace SIXSTEP_TEST_FILE

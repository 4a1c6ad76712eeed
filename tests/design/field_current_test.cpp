// SPDX-License-Identifier: Apache-2.0
// The current loops of the field-oriented drive are compared with a closed form for the same plant.
#include "sixstep/design/loops/field_current.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace SIXSTEP_TEST_FILE {

using namespace sixstep;
using namespace sixstep::design;

constexpr double R = 0.515, L_H = 0.286e-3, T = 50e-6;

/// The errors of a step with the plant i[n+1] = -a0 i[n] + b0 v[n - delay] and the PI of the chip. The first
/// error is e[0] = 1.
std::vector<double> errors_of_step(const FieldAxis& axis, int delay_periods, std::size_t samples) {
  const ZohPlant plant = current_plant(R, L_H, T);
  control::PiConfig<double> config{axis.gains.d1, axis.gains.d0, 1e9};
  control::PiState<double> pi;
  double i = 0.0, waiting = 0.0;
  std::vector<double> errors;
  for (std::size_t n = 0; n < samples; ++n) {
    errors.push_back(1.0 - i);
    const double asked = pi_step(config, pi, errors.back());
    const double v = delay_periods > 0 ? waiting : asked;
    waiting = asked;
    i = -plant.a0 * i + plant.b0 * v;
  }
  return errors;
}

TEST(FieldAxis, WithoutDelayTheErrorFallsByThePoleClaimed) {
  for (const double bandwidth : {500.0, 6283.0, 20000.0}) {
    const auto axis = field_axis(R, L_H, {bandwidth, T, 0});
    ASSERT_TRUE(axis);
    EXPECT_DOUBLE_EQ(axis->pole, std::exp(-bandwidth * T));
    const std::vector<double> e = errors_of_step(*axis, 0, 40);
    for (std::size_t n = 0; n < e.size(); ++n)
      EXPECT_NEAR(e[n], std::pow(axis->pole, static_cast<double>(n)), 1e-13) << n;
  }
}

/// The recurrence e[n+1] = e[n] - k e[n-1] has the roots z and 1 - z. The start values e = 1, 1 determine the
/// weights of the two roots.
TEST(FieldAxis, WithADelayTheErrorIsThatOfBothPolesClaimed) {
  for (const double bandwidth : {500.0, 6283.0, 0.6 / T}) {
    const auto axis = field_axis(R, L_H, {bandwidth, T, 1});
    ASSERT_TRUE(axis);
    const double z = axis->pole, other = axis->other_pole;
    EXPECT_DOUBLE_EQ(z, std::exp(-bandwidth * T));
    EXPECT_DOUBLE_EQ(other, 1 - z);
    const std::vector<double> e = errors_of_step(*axis, 1, 40);
    const double a = (1 - other) / (z - other);
    for (std::size_t n = 0; n < e.size(); ++n)
      EXPECT_NEAR(e[n],
                  a * std::pow(z, static_cast<double>(n)) + (1 - a) * std::pow(other, static_cast<double>(n)),
                  1e-12)
          << n;
  }
}

TEST(FieldAxis, RefusesWhatADelayDoesNotAllow) {
  EXPECT_TRUE(field_axis(R, L_H, {0.69 / T, T, 1}));
  const auto axis = field_axis(R, L_H, {0.7 / T, T, 1});
  ASSERT_FALSE(axis);
  EXPECT_EQ(axis.problems()[0].where, "bandwidth_rad_s");
  EXPECT_TRUE(field_axis(R, L_H, {0.7 / T, T, 0}));
  EXPECT_FALSE(field_axis(R, L_H, {0.0, T, 0}));
  EXPECT_NEAR(usual_field_bandwidth_rad_s(T) * T, std::numbers::pi / 10, 1e-15);
}

MotorModel sine_motor() {
  MotorModel motor;
  motor.machine = {R, L_H, 0.01675, 8, plant::BackEmf::sine, 120.0};
  return motor;
}

TEST(FieldMachine, HasTheFundamentalOfItsBackEmfAndTheAxesOfItsSheet) {
  Sheet sheet;
  MotorModel motor = sine_motor();
  EXPECT_DOUBLE_EQ(field_machine(motor, sheet).magnet_V_s, 0.01675);
  EXPECT_EQ(field_machine(motor, sheet).L_q_H, L_H);
  sheet.d_axis_inductance_mH = base::Quantity{0.24, "", ""};
  sheet.q_axis_inductance_mH = base::Quantity{0.34, "", ""};
  const FieldMachine salient = field_machine(motor, sheet);
  EXPECT_DOUBLE_EQ(salient.L_d_H, 0.24e-3);
  EXPECT_DOUBLE_EQ(salient.L_q_H, 0.34e-3);
  motor.machine.back_emf = plant::BackEmf::trapezoid;
  // The fundamental of a trapezoid with a flat top of 120 degrees is (4/pi) sin(30 degrees)/(pi/6).
  const double fundamental = 4 / std::numbers::pi * 0.5 / (std::numbers::pi / 6);
  EXPECT_NEAR(field_machine(motor, Sheet{}).magnet_V_s, 0.01675 * fundamental, 1e-15);
}

TEST(FieldMachine, TorquePerAmpereIsTheOptimumOfItsTorque) {
  Sheet sheet;
  sheet.d_axis_inductance_mH = base::Quantity{0.24, "", ""};
  sheet.q_axis_inductance_mH = base::Quantity{0.34, "", ""};
  const FieldMachine m = field_machine(sine_motor(), sheet);
  const control::TorquePerAmpereConfig<double> config{torque_per_ampere_gain(m)};
  // With the flux linkage psi = K_e/p, the gradient of the torque along the circle of constant current is 0:
  // psi i_d + (L_d - L_q)(i_d^2 - i_q^2) = 0.
  const double psi = 0.01675 / 8, i_q = 12.0, i_d = least_current_d(config, i_q);
  EXPECT_LT(i_d, -1.0);
  EXPECT_NEAR(psi * i_d - 0.1e-3 * (i_d * i_d - i_q * i_q), 0.0, 1e-15);
}

TEST(Weakening, IsTenTimesSlowerThanTheCurrentsWhereTheCircleEnds) {
  const FieldMachine m = field_machine(sine_motor(), Sheet{});
  const FieldLoopSpec spec{4000.0, T, 1};
  const double K = weakening_gain(m, 24.0, spec), w_0 = 24.0 / (std::numbers::sqrt3 * 0.01675);
  EXPECT_NEAR(1 - K * w_0 * 8 * L_H, std::exp(-4000.0 * T / 10), 1e-15);
}

}  // namespace SIXSTEP_TEST_FILE

// SPDX-License-Identifier: Apache-2.0
#include "sixstep/design/loops/speed_laws.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace SIXSTEP_TEST_FILE {

using namespace sixstep;
using design::SpeedLawDesign;
using design::SpeedLawSpec;
using ::testing::HasSubstr;

/// The maxon 251601 with a torque of 0.1 N m and J = 135 g cm2. The friction is large enough to have an
/// effect.
SpeedLawSpec maxon() {
  return {.full_rad_s2 = 0.1 / 1.35e-5,
          .fades_1_s = 2.0,
          .lag_periods = 1.8,
          .limit = 1.0,
          .settle_s = 20e-3,
          .ratio = 5.0,
          .period_s = 30e-6};
}

double step_of(const SpeedLawDesign& d, const std::string& symbol) {
  for (const design::DerivationStep& step : d.steps)
    if (step.symbol == symbol) return step.value;
  ADD_FAILURE() << "no step " << symbol;
  return 0.0;
}

/// The designed gain minimises a weighted sum of squares. The Riccati equation, iterated from zero, gives the
/// same gain.
TEST(SpeedLawDesign, StateFeedbackIsTheLinearQuadraticRegulatorOfItsWeight) {
  for (const double settle : {2e-3, 20e-3, 0.5}) {
    SpeedLawSpec spec = maxon();
    spec.settle_s = settle;
    const auto d = design::state_feedback(spec);
    ASSERT_TRUE(d) << to_string(d.problems()[0]);
    const control::ObservedSpeedConfig<double>& k = d->gains.observed;
    const double B = (k.b + k.g) * (1 - k.c), r = step_of(*d, "r");
    double P = 0.0;
    for (int n = 0; n < 400000; ++n) P = 1.0 + k.a * k.a * P * r / (r + B * B * P);
    EXPECT_NEAR(step_of(*d, "P") / P, 1.0, 1e-9) << settle;
    EXPECT_NEAR(k.K / (k.a * B * P / (r + B * B * P)), 1.0, 1e-9) << settle;
    EXPECT_NEAR(k.a - B * k.K, std::exp(-4.6 * 30e-6 / settle), 1e-14) << settle;
    EXPECT_NEAR(k.a, std::exp(-2.0 * 30e-6), 1e-15);
  }
}

/// The friction term is equal to the effect of friction over a sample. The trace and the determinant of the
/// observer's matrix have the values of its double pole.
TEST(SpeedLawDesign, ObserverAndFrictionAreWhatTheyClaim) {
  for (const auto& d : {design::state_feedback(maxon()), design::disturbance_rejection(maxon())}) {
    ASSERT_TRUE(d);
    const control::ObservedSpeedConfig<double>& k = d->gains.observed;
    const double z_o = std::exp(-5 * 4.6 * 30e-6 / 20e-3);
    EXPECT_NEAR(d->fast_pole, z_o, 1e-15);
    // The predicted error changes by the matrix [a - k_1, -b; L_l, 1] with k_1 = a L_w + b L_l.
    const double k_1 = k.a * k.L_w + k.b * k.L_l;
    EXPECT_NEAR(k.a - k_1 + 1, 2 * z_o, 1e-14);
    EXPECT_NEAR(k.a - k_1 + k.b * k.L_l, z_o * z_o, 1e-14);
    EXPECT_NEAR(k.a + k.b * k.f, 1.0, 1e-15);
  }
}

TEST(SpeedLawDesign, DisturbanceRejectionKnowsTheAccelerationAlone) {
  const auto d = design::disturbance_rejection(maxon());
  ASSERT_TRUE(d);
  EXPECT_DOUBLE_EQ(step_of(*d, "b_0"), 0.1 / 1.35e-5);
  EXPECT_DOUBLE_EQ(step_of(*d, "w_c"), 230.0);
  EXPECT_DOUBLE_EQ(step_of(*d, "w_o"), 1150.0);
  EXPECT_EQ(d->gains.observed.c, 0.0);
  EXPECT_EQ(d->gains.observed.a, 1.0);
}

TEST(SpeedLawDesign, TheBoundaryLayerFollowsFromItsPole) {
  const auto d = design::sliding_mode(maxon());
  ASSERT_TRUE(d);
  const control::SlidingSpeedConfig<double>& k = d->gains.sliding;
  const double b = 0.1 / 1.35e-5 * 30e-6;
  EXPECT_NEAR(1 - b * k.reach / k.layer, std::exp(-5 * 4.6 * 30e-6 / 20e-3), 1e-15);
  EXPECT_NEAR(k.f * b, 1 - std::exp(-4.6 * 30e-6 / 20e-3), 1e-15);
  EXPECT_NEAR(step_of(*d, "t_r"), 1.35e-5 / 0.1, 1e-15);
}

/// The lag of the current loop is the sum of the errors after a step of the current reference, with and
/// without a delay of one period.
TEST(SpeedLawDesign, ACurrentLoopIsLateByResistanceOverIntegralGain) {
  const double R = 1.03, L = 0.572e-3, T = 30e-6;
  const auto placed = design::place_poles(design::current_plant(R, L, T), 1e-3, 0.9, T);
  ASSERT_TRUE(placed);
  const auto [d1, d0] = placed->gains;
  for (const int delay : {0, 1}) {
    double i = 0, u = 0, before = 0, late = 0, waits = 0;
    for (int n = 0; n < 20000; ++n) {
      const double error = 1 - i;
      late += error;
      u += d1 * error + d0 * before;
      before = error;
      const double acts = delay == 0 ? u : waits;
      waits = u;
      i = -placed->plant.a0 * i + placed->plant.b0 * acts;
    }
    EXPECT_NEAR(design::current_lag_periods(R, d1 + d0), late - 0.5, 1e-9) << delay;
  }
  EXPECT_EQ(design::current_lag_periods(R, 10 * R), 0.0) << "no torque comes before it is asked for";
}

/// The polynomial p with the coefficients c_k, applied to the sequence x at sample n: the sum of c_k delta^k
/// x, with delta x[n] = x[n+1] - x[n].
double applied(const design::Polynomial& p, std::vector<double> x, std::size_t n) {
  double sum = 0.0;
  x.erase(x.begin(), x.begin() + static_cast<std::ptrdiff_t>(n));
  for (const double c : p) {
    sum += c * x[0];
    for (std::size_t k = 0; k + 1 < x.size(); ++k) x[k] = x[k + 1] - x[k];
  }
  return sum;
}

/// Checks that the block computes q u = r setpoint - y speed (polynomials q, r, y; output u) for arbitrary
/// signals. The inputs are noise.
template <class Step>
void expect_linear(const design::LinearLaw& law, Step step) {
  std::mt19937 random{20261126};
  std::uniform_real_distribution<double> drawn(-1.0, 1.0);
  std::vector<double> r, y, u;
  for (int n = 0; n < 40; ++n) {
    r.push_back(drawn(random));
    y.push_back(n == 0 ? 0.0 : drawn(random));
    u.push_back(step(r.back() - y.back(), y.back()));
  }
  double moved = 0.0;
  for (std::size_t n = 0; n + 8 < u.size(); ++n) {
    const std::vector<double> part_r(r.begin(), r.begin() + static_cast<std::ptrdiff_t>(n + 7)),
        part_y(y.begin(), y.begin() + static_cast<std::ptrdiff_t>(n + 7)),
        part_u(u.begin(), u.begin() + static_cast<std::ptrdiff_t>(n + 7));
    const double left = applied(law.q, part_u, n),
                 right = applied(law.r, part_r, n) - applied(law.y, part_y, n);
    EXPECT_NEAR(left, right, 1e-12) << n;
    moved = std::fmax(moved, std::fabs(left));
  }
  EXPECT_GT(moved, 1e-3);
}

TEST(SpeedLawDesign, LinearLawsAreWhatTheBlocksCompute) {
  SpeedLawSpec spec = maxon();
  spec.settle_s = 2e-3;
  spec.fades_1_s = 200;
  for (const auto& d : {design::state_feedback(spec), design::disturbance_rejection(spec)}) {
    ASSERT_TRUE(d);
    control::ObservedSpeedState<double> state{};
    expect_linear(design::linear(d->gains.observed), [&](double error, double speed) {
      return observed_speed_step(d->gains.observed, state, error, speed, -1e9, 1e9);
    });
  }
  const auto d = design::sliding_mode(spec);
  ASSERT_TRUE(d);
  control::SlidingSpeedConfig<double> wide = d->gains.sliding;
  wide.reach *= 1e6;
  wide.layer *= 1e6;
  control::SlidingSpeedState<double> sliding{};
  expect_linear(design::linear(wide), [&](double error, double speed) {
    return sliding_speed_step(wide, sliding, error, speed, -1e9, 1e9);
  });
  control::DriveExtras<double> x;
  x.speed_law = control::SpeedLaw::positional;
  x.speed = {0.4, 0.03, 0.1, 1e9, 0.0};
  x.speed_derivative = {0.2, 0.3};
  x.speed_weight_off = 0.15;
  control::DriveExtrasState<double> state{};
  control::PiState<double> pi{};
  expect_linear(design::linear(x.speed, x.speed_derivative, x.speed_weight_off),
                [&](double error, double speed) {
                  return control::detail::speed_with_extras<double>(x, state, {}, pi, error, speed, nullptr);
                });
}

/// A PI that is written as a linear law gives the same loop as the PI itself, both from its setpoint and at
/// its output.
TEST(SpeedLawDesign, APiAsALinearLawIsItsLoop) {
  design::DriveLoops loops;
  loops.motor.machine.R_ohm = 0.515;
  loops.motor.machine.L_H = 0.286e-3;
  loops.motor.K_t_Nm_A = 0.0335;
  loops.motor.shaft.J_kg_m2 = 1.35e-5;
  loops.winding = design::driven_pair(loops.motor, control::Chopping::soft);
  loops.period_s = 30e-6;
  loops.late_periods = 1;
  loops.current = {4.1, -3.7};
  loops.speed = {0.016, -0.0157};
  loops.current_at_full_torque_A = 23;
  const design::LinearLaw pi{{0.016 - 0.0157, 0.016}, {0.016 - 0.0157, 0.016}, {0.0, 1.0}};
  for (const double turn : {1e-3, 1e-2, 0.1, 1.0}) {
    const design::Complex L = open_speed_loop(loops).at(turn);
    for (const design::Transfer& other : {speed_loop_by_setpoint(loops, pi), open_speed_loop(loops, pi)}) {
      const design::Complex ratio = other.at(turn) / L;
      EXPECT_NEAR(ratio.re, 1.0, 1e-9);
      EXPECT_NEAR(ratio.im, 0.0, 1e-9);
    }
  }
}

TEST(SpeedLawDesign, SaysWhatCannotBeDesigned) {
  SpeedLawSpec slow = maxon();
  slow.fades_1_s = 300.0;
  const auto d = design::state_feedback(slow);
  ASSERT_FALSE(d);
  EXPECT_THAT(
      to_string(d.problems()[0]),
      HasSubstr(
          "settle_s = 0.02 is longer than the settling time that friction causes without a controller, 0.01533 s"));
  EXPECT_TRUE(design::disturbance_rejection(slow));
  SpeedLawSpec late = maxon();
  late.lag_periods = 1e6;
  ASSERT_FALSE(design::state_feedback(late));
  EXPECT_FALSE(design::state_feedback(late).problems()[0].cure.empty());
  SpeedLawSpec nothing;
  EXPECT_EQ(design::sliding_mode(nothing).problems().size(), 3u);
}

}  // namespace SIXSTEP_TEST_FILE

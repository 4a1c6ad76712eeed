// SPDX-License-Identifier: Apache-2.0
// Deadbeat current control of a winding whose voltage is constant over a period. The current reaches its
// reference one period after the command takes effect. With a wrong model, the error has a closed form.
#include "sixstep/design/loops/deadbeat.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/control/scalars.hpp"

namespace SIXSTEP_TEST_FILE {

using namespace sixstep;
using namespace sixstep::control;

constexpr double R = 1.03, L = 0.572e-3, T = 30e-6;
constexpr design::DeadbeatSpec spec{.R_ohm = R, .L_H = L, .K_t_Nm_A = 0.0335, .period_s = T, .limit_V = 24.0};

/// Current, in A, after the time `time_s` in a winding with the inductance L_H. The argument u_minus_e is the
/// constant voltage minus the back-EMF.
double winding(double i, double u_minus_e, double time_s, double L_H = L) {
  const double a = std::exp(-R * time_s / L_H);
  return a * i + (1 - a) / R * u_minus_e;
}

DeadbeatConfig<double> config_of(double wait_periods, double correction = design::usual_correction) {
  design::DeadbeatSpec s = spec;
  s.wait_periods = wait_periods;
  s.correction = correction;
  return design::deadbeat(s)->config;
}

/// The deadbeat loop with its winding. A command takes effect `wait` periods after the sample.
struct Loop {
  DeadbeatConfig<double> config;
  double wait, L_H = L;
  DeadbeatState<double> state{};
  double i = 0, in_effect = 0;

  /// Advances from one sample to the next.
  double tick(double reference, double e, double speed = 0) {
    const double before = in_effect;
    in_effect = deadbeat_step(config, state, reference, i, speed);
    i = winding(i, before - e, wait * T, L_H);
    i = winding(i, in_effect - e, (1 - wait) * T, L_H);
    return i;
  }
};

TEST(Deadbeat, ReachesItsReferenceOnePeriodAfterTheAnswerBegins) {
  const double e = spec.K_t_Nm_A * 200;  // back-EMF at 200 rad/s, a speed that the loop measures
  for (const double wait : {0.0, 1.0}) {
    Loop loop{config_of(wait), wait};
    for (int n = 0; n < 40; ++n) loop.tick(0.0, e, 200);
    ASSERT_NEAR(loop.i, 0.0, 1e-3);  // error of the first tick, which had no previous voltage
    loop.state.missed = 0;
    loop.i = 0;
    loop.in_effect = loop.state.u = e;
    loop.state.predicted = 0;
    for (int n = 0; n < 12; ++n) {
      const double i = loop.tick(0.5 * n, e, 200);
      const int whole = static_cast<int>(wait);
      if (n >= whole) {
        EXPECT_NEAR(i, 0.5 * (n - whole), 1e-12) << n;
      }
    }
  }
}

TEST(Deadbeat, AnAnswerHalfAPeriodAfterItsSampleReachesItWhereThePeriodEnds) {
  Loop loop{config_of(0.5), 0.5};
  loop.tick(0.8, 0.0);
  // The commanded voltage acts for another half period after the next sample.
  EXPECT_NEAR(winding(loop.i, loop.in_effect, 0.5 * T), 0.8, 1e-12);
}

TEST(Deadbeat, OfAVoltageThatTheModelLacksAPartIsLeftAtEachSample) {
  constexpr double g = 0.25, e = 1.5;
  Loop loop{config_of(0.0, g), 0.0};
  const double b = (1 - std::exp(-R * T / L)) / R;
  for (int n = 0; n < 30; ++n) EXPECT_NEAR(loop.tick(1.0, e) - 1.0, -b * e * std::pow(1 - g, n), 1e-12) << n;
}

TEST(Deadbeat, AnInductanceOffByMPutsThePoleAtOneMinusOneOverM) {
  // The loop has no correction. R is so small that the decay of the current is negligible.
  for (const double m : {0.55, 0.8, 1.25, 2.0}) {
    design::DeadbeatSpec s = spec;
    s.R_ohm = 1e-9;
    s.correction = 0;
    DeadbeatState<double> state;
    const DeadbeatConfig<double> config = design::deadbeat(s)->config;
    double i = 0, error = 1;
    for (int n = 0; n < 8; ++n) {
      i += T / (m * L) * deadbeat_step(config, state, 1.0, i, 0.0);
      error *= 1 - 1 / m;
      EXPECT_NEAR(1 - i, error, 1e-6 * std::fabs(error) + 1e-9) << m << " after " << n;
    }
  }
}

TEST(Deadbeat, WhatTheLimitCutsOffIsForeseenAndNothingWindsUp) {
  Loop loop{config_of(1.0), 1.0};
  double before = 0;
  int ticks = 0;
  while (std::fabs(loop.i - 10.0) > 1e-9 && ticks < 50) {
    loop.tick(10.0, 0.0);
    EXPECT_NEAR(loop.state.missed, 0.0, 1e-9);
    EXPECT_GE(loop.i, before - 1e-12);
    EXPECT_LE(loop.i, 10.0 + 1e-9);
    before = loop.i;
    ++ticks;
  }
  // The current at full voltage U is i(t) = U/R (1 - exp(-R t/L)). The least time to 10 A, in periods, is
  // rounded up. The waiting time of one period is added.
  const double least = -L / R * std::log1p(-10.0 * R / 24.0) / T;
  EXPECT_EQ(ticks, static_cast<int>(std::ceil(least)) + 1);
}

TEST(Deadbeat, AWaitOfMoreThanAPeriodIsRefused) {
  design::DeadbeatSpec s = spec;
  s.wait_periods = 1.5;
  EXPECT_FALSE(design::deadbeat(s));
}

TEST(Deadbeat, DefaultsAnswerNothing) {
  DeadbeatState<float> state;
  EXPECT_EQ(deadbeat_step(DeadbeatConfig<float>{}, state, 5.0f, 1.0f, 100.0f), 0.0f);
}

template <class Scalar>
class DeadbeatScalars : public ::testing::Test {};
TYPED_TEST_SUITE(DeadbeatScalars, Scalars);

/// The bases are 40 A, 60 V and 1500 rad/s. Each format agrees with double within its digits. The measured
/// current is the current of the simulated winding, so errors do not accumulate. Each tick has a new rounding
/// error, which the factor 1/b converts to volts.
TYPED_TEST(DeadbeatScalars, FollowsTheDoubleOne) {
  using S = TypeParam;
  constexpr double A = 40, V = 60, W = 1500;
  const DeadbeatConfig<double> d = config_of(1.0);
  const auto over = [](const HeldWinding<double>& h) {
    return HeldWinding<S>{static_cast<Gain<S>>(h.decay), static_cast<Gain<S>>(h.A_per_V * V / A)};
  };
  const DeadbeatConfig<S> config{over(d.wait),
                                 over(d.rest),
                                 static_cast<Gain<S>>(d.decay),
                                 static_cast<Gain<S>>(d.V_per_A * A / V),
                                 static_cast<Gain<S>>(d.correction_V_per_A * A / V),
                                 static_cast<Gain<S>>(d.K_t_V_s * W / V),
                                 static_cast<S>(d.limit / V)};
  DeadbeatState<S> state;
  double i = 0, in_effect = 0;
  const double e = spec.K_t_Nm_A * 200 + 0.7;
  for (int n = 0; n < 200; ++n) {
    const double reference = n < 100 ? 6.0 : -3.0;
    const S u = deadbeat_step(config, state, static_cast<S>(reference / A), static_cast<S>(i / A),
                              static_cast<S>(200.0 / W));
    i = winding(i, in_effect - e, T);
    in_effect = static_cast<double>(u) * V;
    // The model lacks 0.7 V. Each tick reduces this difference to 3/4. The current contains the effect of two
    // ticks, each with the factor b. The remaining error is the rounding of a current, a few digits per tick.
    const double unknown = 0.7 / d.V_per_A * (1 + 4.0 / 3) * std::pow(0.75, n - 1);
    if (n % 100 >= 60) {
      EXPECT_NEAR(i, reference, 8 * digit<S>() * A + unknown) << n;
    }
  }
}

}  // namespace SIXSTEP_TEST_FILE

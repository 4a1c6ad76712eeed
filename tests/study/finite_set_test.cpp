// SPDX-License-Identifier: Apache-2.0
// The finite-set law selects one of the states of three legs. The scenarios test the distance of the currents
// from their reference, the turn-ons per second, the rise time of a step, and the effect of a delay.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

#include "sixstep/base/angle.hpp"
#include "sixstep/design/loops/finite_set.hpp"
#include "sixstep/sim/run.hpp"
#include "sixstep/study/check/check.hpp"
#include "sixstep/study/compile/chip.hpp"
#include "sixstep/study/compile/compile.hpp"
#include "tests/support/field_ticks.hpp"
#include "tests/support/figures.hpp"
#include "tests/support/scenarios.hpp"

namespace SIXSTEP_TEST_FILE {

using namespace sixstep;
using namespace sixstep::testing;
using namespace sixstep::study;
using control::Mode;

constexpr double T = 20e-6, U = 24.0, R = 0.515, L = 0.286e-3, K_e = 0.01675;
/// b is the current that one volt causes in a period, in A/V. band_A is the largest distance between a
/// reference and the nearest of the seven possible currents.
const double b = (1 - std::exp(-R * T / L)) / R, band_A = 2 / (3 * std::numbers::sqrt3) * b * U;

/// The 251601 with a sinusoidal back-EMF of the same peak, at 50 kHz. The inertia is so large that the speed
/// is constant.
Scenario finite_set(double reference, double speed_rad_s, int delay) {
  Scenario s = maxon_scenario(Mode::current, reference);
  s.sheet.back_emf = design::BackEmfShape::sine;
  s.sheet.torque_constant_mNm_A = std::nullopt;
  s.sheet.back_emf_mV_s = base::Quantity{1e3 * K_e, "phase", ""};
  s.control.drive = FirmwareKind::field;
  s.control.field.law = FieldLaw::finite_set;
  s.pwm.alignment = Alignment::centre;
  s.pwm.period_s = T;
  s.pwm.delay_periods = delay;
  s.initial.speed_rad_s = speed_rad_s;
  s.load.inertia_kg_m2 = 10;
  s.duration_s = 20e-3;
  return s;
}

struct Seen {
  double t_s = 0.0;
  control::Dq<double> measured, reference;
};

std::vector<Seen> seen_of(const Scenario& s) {
  return field_ticks(s, [](const auto& rig) {
    const auto& drive = rig.firmware().state();
    return Seen{rig.now().seconds(), drive.measured, drive.reference};
  });
}

/// The largest distance of a sampled current from its reference, from 2 ms on.
double farthest_A(const Scenario& s) {
  double most = 0.0;
  for (const Seen& x : seen_of(s))
    if (x.t_s > 2e-3)
      most = std::fmax(most, std::hypot(x.measured.d - x.reference.d, x.measured.q - x.reference.q));
  return most;
}

/// Error that the rotation by x = w_e T within a period causes: x^2/24 of the voltage and of the back-EMF.
double turning_A(double speed_rad_s) {
  const double x = 8 * speed_rad_s * T;
  return x * x / 24 * b * U;
}

/// If the steady voltage R I + w K_e is inside the bus's hexagon by at least the radius of the triangles,
/// this radius is a bound of the distance.
TEST(FiniteSet, TheCurrentsStayWithinTheTrianglesOfTheBus) {
  for (const int delay : {0, 1})
    for (const double w : {-100.0, 20.0, 100.0}) {
      const double I = w < 0 ? -4.0 : 4.0;
      ASSERT_LT(R * std::fabs(I) + std::fabs(w) * K_e, U / std::numbers::sqrt3 - band_A / b);
      const double most = farthest_A(finite_set(I, w, delay));
      EXPECT_LE(most, band_A + 2 * turning_A(w)) << "delay " << delay << ", " << w;
      EXPECT_GT(most, 0.9 * band_A) << "and is used";
    }
}

TEST(FiniteSet, ADelayThatIsNotMadeUpForIsWorse) {
  Scenario s = finite_set(4.0, 100.0, 1);
  s.control.field.delay_compensation = false;
  EXPECT_GT(farthest_A(s), 1.5 * band_A);
}

/// The law has no integral. The mean current and the mean torque are therefore equal to the reference only
/// within the band.
TEST(FiniteSet, MeanCurrentAndTorqueAreThoseAskedForWithinTheBand) {
  for (const int delay : {0, 1}) {
    Scenario s = finite_set(4.0, 100.0, delay);
    ask(s, over(MetricKind::mean, Signal::quadrature_current, 4e-3));
    ask(s, over(MetricKind::mean, Signal::direct_current, 4e-3));
    ask(s, over(MetricKind::mean, Signal::torque, 4e-3));
    const std::vector<double> f = figures_of(s);
    EXPECT_NEAR(f[0], 4.0, band_A);
    EXPECT_NEAR(f[1], 0.0, band_A);
    EXPECT_NEAR(f[2], 1.5 * K_e * 4.0, 1.5 * K_e * band_A);
  }
}

/// A switch turns on in at most every second period.
TEST(FiniteSet, NoSwitchIsFasterThanHalfTheSamples) {
  double fastest = 0.0;
  for (const double w : {20.0, 100.0, 400.0})
    for (const Signal gate : {Signal::gate_T1, Signal::gate_T4, Signal::gate_T6}) {
      Scenario s = finite_set(4.0, w, 1);
      ask(s, over(MetricKind::switching_frequency, gate, 4e-3));
      const double f = figures_of(s)[0];
      EXPECT_LE(f, 1 / (2 * T));
      fastest = std::fmax(fastest, f);
    }
  EXPECT_GT(fastest, 0.1 / T) << "it does switch";
}

/// Without PWM pulses, the switching frequency of the drive is the mean frequency of its three upper
/// switches.
TEST(FiniteSet, ItsFrequencyIsTheMeanOfTheLegs) {
  Scenario s = finite_set(4.0, 60.0, 1);
  for (const Signal what : {Signal::current, Signal::gate_T1, Signal::gate_T3, Signal::gate_T5})
    ask(s, over(MetricKind::switching_frequency, what, 4e-3));
  const std::vector<double> f = figures_of(s);
  EXPECT_GT(f[0], 0.02 / T);
  EXPECT_NEAR(f[0], (f[1] + f[2] + f[3]) / 3, 1e-9 / T);
}

/// A weight on the switching of a leg reduces the turn-ons. Reaching the nearest state switches at most three
/// legs, and their weight bounds the additional distance.
TEST(FiniteSet, AWeightOnSwitchingSlowsIt) {
  double last = 1 / T;
  for (const double weight : {0.0, 0.6, 1.2}) {
    Scenario s = finite_set(4.0, 60.0, 1);
    s.control.field.switching_weight_A = weight;
    ask(s, over(MetricKind::switching_frequency, Signal::gate_T1, 4e-3));
    const double f = figures_of(s)[0], most = farthest_A(s);
    EXPECT_LT(f, 0.95 * last);
    EXPECT_LE(most, std::sqrt(band_A * band_A + 3 * weight * weight) + 2 * turning_A(60));
    last = f;
  }
}

/// With a locked rotor, the bus voltage limits the rate of rise. It limits the voltage to U/sqrt 3 minus R I
/// in the direction of the smallest reach, and to 2/3 U in the direction of the largest reach. A PI
/// controller whose bandwidth is a twentieth of the control frequency is slower.
TEST(FiniteSet, AStepTakesWhatTheBusAllows) {
  const double I = 8.0;
  const auto rise_s = [&](FieldLaw law, int delay) {
    Scenario s = finite_set(I, 0.0, delay);
    s.control.field.law = law;
    s.load.locked = true;
    for (const Seen& x : seen_of(s))
      if (x.measured.q > 0.9 * I) return x.t_s;
    return 1.0;
  };
  const double fastest = -L / R * std::log(1 - 0.9 * I * R / (2 * U / 3)),
               slowest = -L / R * std::log(1 - I * R / (U / std::numbers::sqrt3));
  for (const int delay : {0, 1}) {
    const double rise = rise_s(FieldLaw::finite_set, delay), pi = rise_s(FieldLaw::pi, delay);
    EXPECT_GE(rise, fastest + delay * T - 1e-12);
    EXPECT_LE(rise, slowest + (1 + delay) * T);
    EXPECT_LT(rise, 0.7 * pi);
  }
}

TEST(FiniteSet, NoStateBeyondThePeakIsTakenWhileAnotherIsLeft) {
  Scenario s = finite_set(6.0, 60.0, 1);
  s.control.field.peak_A = 5.0;
  double most = 0.0, sum = 0.0;
  int n = 0;
  for (const Seen& x : seen_of(s)) {
    most = std::fmax(most, std::hypot(x.measured.d, x.measured.q));
    if (x.t_s > 4e-3) sum += x.measured.q, ++n;
  }
  EXPECT_LE(most, 5.0 + 2 * turning_A(60));
  EXPECT_GT(sum / n, 5.0 - 2 * band_A);
}

/// With L_q = 2 L_d, the smaller inductance determines the band. The model omits half of the change that
/// saliency causes in a period.
TEST(FiniteSet, ASalientRotorStaysWithinTheBandOfItsSmallerInductance) {
  Scenario s = finite_set(4.0, 60.0, 1);
  s.sheet.inductance_mH = std::nullopt;
  s.sheet.d_axis_inductance_mH = base::Quantity{0.2, "", ""};
  s.sheet.q_axis_inductance_mH = base::Quantity{0.4, "", ""};
  const auto designed = design::finite_set({R, 0.2e-3, 0.4e-3, K_e, 8}, T, U);
  const double salient = 8 * 60.0 * 0.2e-3 * designed.config.d_A_per_V * designed.config.d_A_per_V * U / 3;
  EXPECT_LE(farthest_A(s), designed.band_A + 2 * (turning_A(60) + salient));
}

/// Currents that follow the shape of the trapezoidal back-EMF give the requested torque within the band.
TEST(FiniteSet, FollowsTheShapeOfATrapezoid) {
  const double f1 = 4 / base::pi * 0.5 / (base::pi / 6);
  const auto torque = [&](bool harmonic) {
    Scenario s = finite_set(4.0, 20.0, 1);
    s.sheet.back_emf = design::BackEmfShape::trapezoid;
    s.control.field.harmonic_current = harmonic;
    s.duration_s = 2e-3 + 2 * base::pi / 160;
    ask(s, over(MetricKind::maximum, Signal::torque, 2e-3));
    ask(s, over(MetricKind::minimum, Signal::torque, 2e-3));
    ask(s, over(MetricKind::ripple_rms, Signal::torque, 2e-3));
    const std::vector<double> f = figures_of(s);
    return f;
  };
  const double most = 1.5 * K_e * 4 / 3 * band_A * 1.01, asked = 1.5 * K_e * f1 * 4.0;
  const std::vector<double> with = torque(true), without = torque(false);
  EXPECT_LT(with[0], asked + most);
  EXPECT_GT(with[1], asked - most);
  EXPECT_LT(with[2], without[2]);
}

TEST(FiniteSet, WhatItDoesNotDoIsRefusedWithACure) {
  const struct {
    const char* key;
    std::function<void(Scenario&)> make;
  } wrong[] = {{"control.field.bandwidth_Hz", [](Scenario& s) { s.control.field.bandwidth_Hz = 800; }},
               {"control.current", [](Scenario& s) { s.control.current.settle_s = 1e-3; }},
               {"at[0].control.current",
                [](Scenario& s) {
                  s.at.resize(1);
                  s.at[0].time_s = 1e-3;
                  s.at[0].control.current.settle_s = 1e-3;
                }},
               {"control.field.decoupling", [](Scenario& s) { s.control.field.decoupling = false; }},
               {"control.field.voltage_limit",
                [](Scenario& s) { s.control.field.voltage_limit = control::VoltageLimit::axes; }},
               {"control.field.weakening_A", [](Scenario& s) { s.control.field.weakening_A = 2; }},
               {"control.field.advance_periods", [](Scenario& s) { s.control.field.advance_periods = 1; }},
               {"pwm.sample", [](Scenario& s) { s.pwm.sample = SampleAt::middle; }},
               {"control.arithmetic", [](Scenario& s) { s.control.arithmetic = Arithmetic::q31; }},
               {"control.field.peak_A",
                [](Scenario& s) {
                  s.control.field.law = FieldLaw::pi;
                  s.control.field.peak_A = 5;
                }},
               {"control.field.switching_weight_A",
                [](Scenario& s) {
                  s.control.field.law = FieldLaw::pi;
                  s.control.field.switching_weight_A = 0.1;
                }},
               {"control.field.delay_compensation", [](Scenario& s) {
                  s.control.field.law = FieldLaw::pi;
                  s.control.field.delay_compensation = false;
                }}};
  EXPECT_TRUE(check(finite_set(2, 0, 0)).empty());
  for (const auto& [key, make] : wrong) {
    Scenario s = finite_set(2, 0, 0);
    make(s);
    const base::Problems problems = check(s);
    ASSERT_EQ(problems.size(), 1u) << key << (problems.empty() ? "" : to_string(problems.back()));
    EXPECT_EQ(problems[0].where, key);
    EXPECT_FALSE(problems[0].cure.empty());
  }
}

}  // namespace SIXSTEP_TEST_FILE

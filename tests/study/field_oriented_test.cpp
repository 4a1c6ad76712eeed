// SPDX-License-Identifier: Apache-2.0
// The field-oriented drive in a scenario. Its poles are compared with the designed poles. Decoupling, voltage
// circle, field weakening and torque per ampere are compared with their laws. The tests include real sensors
// and refusals. data/scenarios/reference/G15.toml contains a trajectory of an independent solver.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <functional>
#include <numbers>

#include "sixstep/base/angle.hpp"
#include "sixstep/sim/run.hpp"
#include "sixstep/study/check/check.hpp"
#include "sixstep/study/compile/chip.hpp"
#include "sixstep/study/compile/compile.hpp"
#include "sixstep/study/measure/columns.hpp"
#include "sixstep/study/run/run.hpp"
#include "tests/support/field_ticks.hpp"
#include "tests/support/figures.hpp"
#include "tests/support/scenarios.hpp"

namespace SIXSTEP_TEST_FILE {

using namespace sixstep;
using namespace sixstep::testing;
using namespace sixstep::study;
using control::Mode;
using ::testing::HasSubstr;

/// The 251601 with a sinusoidal back-EMF of the same peak. The PWM frequency is 20 kHz, and the delay is one
/// period.
Scenario field_oriented(Mode mode, double reference) {
  Scenario s = maxon_scenario(mode, reference);
  s.sheet.back_emf = design::BackEmfShape::sine;
  s.sheet.torque_constant_mNm_A = std::nullopt;
  s.sheet.back_emf_mV_s = base::Quantity{16.75, "phase", ""};
  s.control.drive = FirmwareKind::field;
  s.pwm.alignment = Alignment::centre;
  s.pwm.period_s = 50e-6;
  s.pwm.delay_periods = 1;
  return s;
}

/// The drive's values at each of its ticks.
struct Tick {
  double t_s = 0.0, speed_rad_s = 0.0, bus_V = 0.0;
  control::Dq<double> measured, reference, voltage;
};

std::vector<Tick> ticks_of(const Scenario& s) {
  return field_ticks(s, [](const auto& rig) {
    const auto& drive = rig.firmware().state();
    return Tick{rig.now().seconds(),
                static_cast<double>(rig.plant().state().w),
                static_cast<double>(rig.plant().state().bus),
                drive.measured,
                drive.reference,
                drive.current.voltage};
  });
}

/// The plant of a locked rotor is R and L. The pulses of a voltage are centred in each period. A voltage over
/// the whole period would change the current by 3e-4 more, which is (T R/L)^2/24 of the change in a period.
TEST(FieldOriented, ACurrentStepHasThePolesThatWereDesigned) {
  for (const int delay : {0, 1}) {
    Scenario s = field_oriented(Mode::current, 2.0);
    s.pwm.delay_periods = delay;
    s.load.locked = true;
    s.duration_s = 2e-3;
    s.control.field.bandwidth_Hz = 800;
    const double z = std::exp(-2 * base::pi * 800 * 50e-6), other = delay == 0 ? 0.0 : 1 - z;
    const std::vector<Tick> ticks = ticks_of(s);
    ASSERT_EQ(ticks.size(), 40u);
    const double a = delay == 0 ? 1.0 : (1 - other) / (z - other);
    for (std::size_t n = 0; n < ticks.size(); ++n) {
      const auto to = [&](double root) { return std::pow(root, static_cast<double>(n)); };
      const double error = n == 0 ? 1.0 : a * to(z) + (delay == 0 ? 0.0 : (1 - a) * to(other));
      EXPECT_NEAR(1 - ticks[n].measured.q / 2.0, error, 1e-3) << "delay " << delay << ", tick " << n;
      EXPECT_NEAR(ticks[n].measured.d, 0.0, 2e-3);
    }
  }
}

constexpr double bandwidth_Hz = 100;

/// The largest |i_d| after a step of i_q. An external drive keeps the speed.
double largest_i_d(bool decoupling) {
  Scenario s = field_oriented(Mode::current, 0.0);
  s.reference = {};
  s.reference.shape = Shape::steps;
  s.reference.times_s = {0.0, 0.02};
  s.reference.values = {0.0, 6.0};
  s.load.dynamometer_times_s = {0.0, 1.0};
  s.load.dynamometer_rad_s = {400.0, 400.0};
  s.control.field.bandwidth_Hz = bandwidth_Hz;
  s.control.field.decoupling = decoupling;
  s.duration_s = 0.03;
  double largest = 0.0;
  for (const Tick& tick : ticks_of(s))
    if (tick.t_s > 0.0195) largest = std::max(largest, std::fabs(tick.measured.d));
  return largest;
}

/// Without decoupling, both axes are one complex current: (L s + R + j w_e L) i = L w_b (s + R/L)/s (i* - i),
/// with the bandwidth w_b. The poles of its step response are the roots of s^2 + (R/L + w_b + j w_e) s + w_b
/// R/L. The delay adds a part of 1.5 T w_b. With decoupling, the added voltage is 1.5 periods old. The error
/// is 1.5 T times the slope of I w_e w_b/((s + R/L)(s + w_b)^2). It is less than 1.5 T w_e I/e, because s/(s
/// + w_b)^2 is at most 1/(e w_b) in time.
TEST(FieldOriented, DecouplingHoldsTheOtherAxisAtSpeed) {
  using Number = std::complex<double>;
  const double w_e = 8 * 400.0, w_b = 2 * base::pi * bandwidth_Hz, a = 0.515 / 0.286e-3, step_A = 6.0,
               T = 50e-6;
  const Number half = Number(a + w_b, w_e) / 2.0, root = std::sqrt(half * half - w_b * a);
  const Number s1 = -half + root, s2 = -half - root;
  double peak = 0.0;
  for (double t = 0.0; t < 10e-3; t += T) {
    const Number response = 1.0 + w_b * ((s1 + a) / (s1 * (s1 - s2)) * std::exp(s1 * t) +
                                         (s2 + a) / (s2 * (s2 - s1)) * std::exp(s2 * t));
    peak = std::max(peak, std::fabs((Number(0, step_A) * response).real()));
  }
  EXPECT_NEAR(largest_i_d(false), peak, 1.5 * T * w_b * peak);
  EXPECT_LT(largest_i_d(true), 1.5 * T * w_e * step_A / std::exp(1.0));
}

TEST(FieldOriented, TheVectorStaysWithinTheCircleOfTheBus) {
  Scenario s = field_oriented(Mode::current, 20.0);
  s.duration_s = 0.05;
  double longest = 0.0;
  for (const Tick& tick : ticks_of(s)) {
    const double length = std::hypot(tick.voltage.d, tick.voltage.q);
    EXPECT_LE(length, tick.bus_V / std::numbers::sqrt3 * (1 + 1e-14));
    longest = std::max(longest, length);
  }
  EXPECT_NEAR(longest, 24 / std::numbers::sqrt3, 1e-9) << "and is used up";
}

/// A free rotor without load reaches the speed at which the back-EMF of the magnet is equal to the radius of
/// the voltage circle. With field weakening, the rotor exceeds this speed.
TEST(FieldOriented, WeakeningTakesItBeyondTheSpeedOfTheBackEmf) {
  Scenario s = field_oriented(Mode::speed, 1100.0);
  s.duration_s = 0.4;
  s.control.speed.torque_limit_Nm = 0.1;
  s.control.current.limit_A = 20.0;
  const double w_0 = 24 / std::numbers::sqrt3 / 0.01675;
  ASSERT_LT(w_0, 1000.0);
  EXPECT_LT(ticks_of(s).back().speed_rad_s, w_0);
  s.control.field.weakening_A = 7.0;
  const Tick last = ticks_of(s).back();
  EXPECT_NEAR(last.speed_rad_s, 1100.0, 1.0);
  EXPECT_LT(last.measured.d, -1.0);
  EXPECT_NEAR(std::hypot(last.voltage.d, last.voltage.q), 0.95 * 24 / std::numbers::sqrt3, 0.1);
  for (const Tick& tick : ticks_of(s))
    EXPECT_LE(std::hypot(tick.reference.d, tick.reference.q), 20.0 * 1.001);
}

/// The reference is i_q. With the same reference, a salient rotor has more torque per ampere if a part of the
/// current is on the d axis.
TEST(FieldOriented, ASalientRotorGetsMostTorquePerAmpere) {
  Scenario s = field_oriented(Mode::current, 12.0);
  s.sheet.inductance_mH = std::nullopt;
  s.sheet.d_axis_inductance_mH = base::Quantity{0.2, "", ""};
  s.sheet.q_axis_inductance_mH = base::Quantity{0.4, "", ""};
  s.load.locked = true;
  s.duration_s = 0.01;
  ask(s, over(MetricKind::mean, Signal::torque, 0.008, 0.01));
  const auto torque_per_A = [&](bool along) {
    s.control.field.torque_per_ampere = along;
    const Tick last = ticks_of(s).back();
    return outcome_of(s).comparisons[0].measured / std::hypot(last.measured.d, last.measured.q);
  };
  const double with = torque_per_A(true), without = torque_per_A(false);
  EXPECT_NEAR(without, 1.5 * 0.01675, 1e-3 * without) << "i_q alone: 3/2 p psi";
  // With a = psi/(2 (L_q - L_d)): i_d = a - sqrt(a^2 + i_q^2) and T = 3/2 p (psi + (L_d - L_q) i_d) i_q.
  const double psi = 0.01675 / 8, a = psi / (2 * 0.2e-3), i_d = a - std::hypot(a, 12.0);
  EXPECT_NEAR(with, 1.5 * 8 * (psi - 0.2e-3 * i_d) * 12.0 / std::hypot(i_d, 12.0), 2e-3 * with);
  EXPECT_GT(with, 1.1 * without);
}

/// The torque is 3/2 p psi i_q at any angle. Only the switching causes a ripple.
TEST(FieldOriented, TheSpeedCascadeReachesItsSpeedInBothFloats) {
  for (const Arithmetic a : {Arithmetic::float64, Arithmetic::float32}) {
    Scenario s = field_oriented(Mode::speed, 300.0);
    s.control.arithmetic = a;
    s.control.speed.settle_s = 20e-3;
    s.load.torque_Nm = 0.05;
    s.duration_s = 0.2;
    ask(s, over(MetricKind::mean, Signal::speed, 0.18, 0.2));
    ask(s, over(MetricKind::mean, Signal::current_reference, 0.18, 0.2));
    const Outcome out = outcome_of(s);
    ASSERT_FALSE(out.fault);
    EXPECT_NEAR(out.comparisons[0].measured, 300.0, 1e-2);
    const double torque = 0.05 + 7.3e-6 * 300;
    EXPECT_NEAR(out.comparisons[1].measured, torque / (1.5 * 0.01675), 1e-2);
  }
}

TEST(FieldOriented, RunsOnWhatABoardMeasures) {
  const std::function<void(Scenario&)> sensors[] = {
      [](Scenario& s) { s.sensors.rotor = RotorSensing::encoder; },
      [](Scenario& s) { s.sensors.rotor = RotorSensing::absolute; },
      [](Scenario& s) { s.sensors.rotor = RotorSensing::resolver; },
      [](Scenario& s) {
        s.sensors.rotor = RotorSensing::hall;
        s.sensors.hall_angle = rig::HallAngleFrom::angle;
        s.sensors.capture_Hz = 16e6;
      }};
  for (const auto& sense : sensors) {
    Scenario s = field_oriented(Mode::speed, 200.0);
    s.control.speed.settle_s = 50e-3;
    s.sensors.currents = rig::CurrentMeasurement::phases;
    s.sensors.current_range_A = 40.0;
    s.load.torque_Nm = 0.02;
    s.duration_s = 0.4;
    sense(s);
    ask(s, over(MetricKind::mean, Signal::speed, 0.35, 0.4));
    const Outcome out = outcome_of(s);
    ASSERT_FALSE(out.fault) << to_string(*out.fault);
    EXPECT_NEAR(out.comparisons[0].measured, 200.0, 1.0) << static_cast<int>(s.sensors.rotor);
  }
}

/// In each row, the recorded columns are equal to the drive's values at its last sample. The figures of merit
/// use the same values.
TEST(FieldOriented, WhatItHoldsIsRecordedAndMeasured) {
  Scenario s = field_oriented(Mode::current, 0.0);
  s.reference = {};
  s.reference.shape = Shape::steps;
  s.reference.times_s = {0.0, 1e-3};
  s.reference.values = {1.0, 3.0};
  s.duration_s = 4e-3;
  const std::vector<Tick> ticks = ticks_of(s);
  const std::function<double(const Tick&)> held[] = {
      [](const Tick& t) { return t.measured.d; },  [](const Tick& t) { return t.measured.q; },
      [](const Tick& t) { return t.reference.d; }, [](const Tick& t) { return t.reference.q; },
      [](const Tick& t) { return t.voltage.d; },   [](const Tick& t) { return t.voltage.q; }};
  s.record.columns = {"i_d_A", "i_q_A", "i_d_ref_A", "i_q_ref_A", "v_d_V", "v_q_V"};
  s.record.grid_s = 50e-6;
  constexpr Signal signals[] = {Signal::direct_current,           Signal::quadrature_current,
                                Signal::direct_current_reference, Signal::quadrature_current_reference,
                                Signal::direct_voltage,           Signal::quadrature_voltage};
  for (const Signal signal : signals) ask(s, over(MetricKind::mean, signal, 0.0, 4e-3));
  ask(s, measure(MetricKind::settling_time, Signal::quadrature_current));
  EXPECT_TRUE(check_columns(s).empty());
  std::vector<std::vector<double>> rows;
  Listeners listeners;
  listeners.on_record = [&](Row row) { rows.emplace_back(row.begin(), row.end()); };
  const auto out = run(s, listeners);
  ASSERT_TRUE(out) << to_string(out.problems()[0]);
  ASSERT_EQ(ticks.size(), 80u);
  ASSERT_EQ(rows.size(), 81u);
  for (std::size_t k = 0; k < 6; ++k) {
    double sum = 0.0;
    for (std::size_t n = 0; n < ticks.size(); ++n) {
      EXPECT_EQ(rows[n][k + 1], held[k](ticks[n])) << s.record.columns[k] << ", row " << n;
      sum += held[k](ticks[n]);
    }
    EXPECT_NEAR(out->comparisons[k].measured, sum / 80, 1e-13 * 24) << s.record.columns[k];
  }
  // If no level is given, the level of i_q is the setpoint. The last sample that is more than 2 % of the step
  // away counts for its whole period.
  double last_out_s = 0.0;
  for (const Tick& t : ticks)
    if (t.t_s >= 1e-3 && std::fabs(t.measured.q - 3.0) > 0.02 * 2.0) last_out_s = t.t_s + 50e-6 - 1e-3;
  EXPECT_GT(last_out_s, 0.0);
  EXPECT_NEAR(out->comparisons[6].measured, last_out_s, 1e-12);
}

/// A motor with 7 pole pairs, 5.12 mWb and 22.3 uH serves as a hand brake at 60 V. An external drive turns it
/// until the back-EMF of the magnet is 35.84 V per phase.
Scenario hand_brake(double reference_A, std::optional<double> weakening_A) {
  Scenario s = field_oriented(Mode::current, reference_A);
  s.sheet.pole_pairs = 7;
  s.sheet.resistance_ohm = base::Quantity{0.0374, "terminal", ""};
  s.sheet.inductance_mH = base::Quantity{0.0446, "terminal", ""};
  s.sheet.back_emf_mV_s = base::Quantity{35.84, "phase", ""};
  s.supply.voltage_V = 60;
  s.pwm.period_s = 33e-6;
  s.control.field.bandwidth_Hz = 1000;
  s.control.field.weakening_A = weakening_A;
  s.load.dynamometer_times_s = {0.0, 0.08, 0.12};
  s.load.dynamometer_rad_s = {0.0, 1000.0, 1000.0};
  s.duration_s = 0.12;
  return s;
}

/// short_bus_test.cpp contains the law; this test adds PWM pulses. The smallest possible current is (35.84 -
/// 34.64) V/|Z| = 7.6 A. Without the limitation, the current would be 460 A.
TEST(FieldOriented, TurnedBeyondTheBusItHoldsItsCurrent) {
  for (const double reference_A : {0.0, 80.0, -80.0})
    for (const std::optional<double> weakening_A : {std::optional<double>{}, std::optional<double>{5.0}}) {
      double largest = 0.0;
      for (const Tick& tick : ticks_of(hand_brake(reference_A, weakening_A)))
        largest = std::max(largest, std::hypot(tick.measured.d, tick.measured.q));
      EXPECT_LT(largest, std::hypot(reference_A, weakening_A.value_or(0.0)) + 7.6 + 5.0)
          << reference_A << " A, weakening " << weakening_A.value_or(0.0);
      EXPECT_GT(largest, 7.0);
    }
}

TEST(FieldOriented, OtherDrivesHoldNoneOfIt) {
  Scenario s = maxon_scenario(Mode::current, 2.0);
  s.record.columns = {"i_q_A"};
  ask(s, over(MetricKind::mean, Signal::quadrature_current, 0.0));
  const base::Problems problems = check(s), unfit = check_columns(s);
  ASSERT_EQ(problems.size(), 1u);
  EXPECT_EQ(problems[0].where, "compare[0].signal");
  EXPECT_THAT(problems[0].cure, HasSubstr("field-oriented"));
  ASSERT_EQ(unfit.size(), 1u);
  EXPECT_THAT(unfit[0].cure, HasSubstr("field-oriented"));
  const auto columns = record_columns(maxon_scenario(Mode::current, 2.0));
  ASSERT_TRUE(columns);
  for (const Column& column : *columns) EXPECT_NE(column.name, "i_q_A");
  Scenario off = field_oriented(Mode::off, 0.0);
  ask(off, over(MetricKind::mean, Signal::direct_current, 0.0));
  ASSERT_EQ(check(off).size(), 1u) << "off, it holds nothing";
}

TEST(FieldOriented, WhatItDoesNotDoIsRefusedWithACure) {
  const struct {
    const char* key;
    std::function<void(Scenario&)> make;
  } wrong[] = {{"pwm.alignment", [](Scenario& s) { s.pwm.alignment = Alignment::edge; }},
               {"pwm.chopping", [](Scenario& s) { s.pwm.chopping = control::Chopping::hard; }},
               {"pwm.commutation", [](Scenario& s) { s.pwm.commutation = CommutationAt::sample; }},
               {"control.mode",
                [](Scenario& s) {
                  s.control.mode = Mode::duty;
                  s.reference.value = 0.1;
                }},
               {"control.arithmetic", [](Scenario& s) { s.control.arithmetic = Arithmetic::q15; }},
               {"control.current.type",
                [](Scenario& s) {
                  s.control.current.type = CurrentLoopType::hysteresis;
                  s.control.current.comparator = Comparator::sampled;
                }},
               {"control.limits", [](Scenario& s) { s.control.limits.current_A = 3.0; }},
               {"control.smooth_chopping", [](Scenario& s) { s.control.smooth_chopping.on = true; }},
               {"control.current.back_emf_feed_forward",
                [](Scenario& s) { s.control.current.back_emf_feed_forward = true; }},
               {"sensors.hall_angle", [](Scenario& s) { s.sensors.rotor = RotorSensing::hall; }},
               {"control.field.bandwidth_Hz",
                [](Scenario& s) {
                  s.control.field.bandwidth_Hz = 500;
                  s.control.current.settle_s = 1e-3;
                }},
               {"control.field.weakening_A",
                [](Scenario& s) {
                  s.control.field.weakening_A = 3.0;
                  s.control.field.voltage_limit = control::VoltageLimit::axes;
                }},
               {"control.field", [](Scenario& s) {
                  s.control.drive = FirmwareKind::lean;
                  s.control.field.decoupling = false;
                }}};
  for (const auto& [key, make] : wrong) {
    Scenario s = field_oriented(Mode::current, 2.0);
    make(s);
    const base::Problems problems = check(s);
    ASSERT_EQ(problems.size(), 1u) << key << (problems.empty() ? "" : to_string(problems.back()));
    EXPECT_EQ(problems[0].where, key);
    EXPECT_FALSE(problems[0].cure.empty());
  }
  Scenario s = field_oriented(Mode::current, 2.0);
  EXPECT_TRUE(check(s).empty());
  s.control.field.weakening_A = 0.01675 / 8 / 0.286e-3 * 1.001;
  ASSERT_FALSE(compile(s)) << "psi/L_d";
  EXPECT_EQ(compile(s).problems()[0].where, "control.field.weakening_A");
  s.control.field.weakening_A = std::nullopt;
  s.control.field.bandwidth_Hz = 2500;
  const auto compiled = compile(s);
  ASSERT_FALSE(compiled) << "ln 2 / T is 2206 Hz";
  EXPECT_EQ(compiled.problems()[0].where, "control.field.bandwidth_Hz");
}

}  // namespace SIXSTEP_TEST_FILE

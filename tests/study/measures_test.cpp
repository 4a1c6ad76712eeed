// SPDX-License-Identifier: Apache-2.0
// Figures of merit of whole runs are compared with closed forms and with the energy balance.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "sixstep/study/check/check.hpp"
#include "sixstep/study/measure/figures.hpp"
#include "tests/support/figures.hpp"

namespace SIXSTEP_TEST_FILE {

using namespace sixstep;
using namespace sixstep::testing;
using namespace sixstep::study;
using control::Mode;

constexpr double eps = 0x1p-52;

/// The rotor is locked at 69 electrical degrees. At this angle, only the pair a, c conducts, with R_tt and
/// L_tt.
Scenario locked(double duty) {
  Scenario s = maxon_scenario(Mode::duty, duty);
  s.load.locked = true;
  s.initial.angle_rad = 1.2 / 8;
  return s;
}
constexpr double R = 1.03, L = 0.572e-3, tau = L / R, U = 24.0, T = 30e-6;

TEST(Measures, RiseOfAStalledMotorIsTauLnNine) {
  Scenario s = locked(1.0);
  s.duration_s = 5e-3;
  Measure rise = measure(MetricKind::rise_time, Signal::current);
  rise.level = U / R;
  rise.start = 0.0;
  ask(s, rise);
  // At 90 %, the slope is 0.1 of the full step per tau.
  EXPECT_NEAR(figures_of(s)[0], tau * std::log(9.0), 64 * eps * tau / 0.1);
}

/// The steady current of a chopped coil. It rises towards U/R for d T (bus voltage U, duty d, period T), and
/// falls towards 0 for the rest of the period.
struct ChoppedCoil {
  double d;
  double low = U / R * std::exp(-(1 - d) * T / tau) * std::expm1(-d * T / tau) / std::expm1(-T / tau);
  double high = U / R * std::expm1(-d * T / tau) / std::expm1(-T / tau);

  /// The integral of (i - d U/R)^2 over an interval of exponential current, i = end + (begin - end)
  /// e^{-t/tau}.
  double square(double begin, double end, double length) const {
    const double a = end - d * U / R, b = begin - end, x = length / tau;
    return a * a * length - 2 * a * b * tau * std::expm1(-x) - b * b * tau / 2 * std::expm1(-2 * x);
  }
  double rms() const { return std::sqrt((square(low, U / R, d * T) + square(high, 0.0, (1 - d) * T)) / T); }
};

TEST(Measures, RippleOfAChoppedCoilIsTheTriangles) {
  for (const double d : {0.5, 0.2}) {
    Scenario s = locked(d);
    s.pwm.chopping = control::Chopping::complementary;
    s.duration_s = 900 * T;  // 48 tau: the remainder of the start is below eps^1.3
    for (const MetricKind kind : {MetricKind::peak_to_peak, MetricKind::ripple_rms, MetricKind::mean})
      ask(s, over(kind, Signal::current, 800 * T, 900 * T));
    ask(s, over(MetricKind::ripple_rms, Signal::line_ca, 800 * T, 900 * T));
    const std::vector<double> figures = figures_of(s);
    const ChoppedCoil coil{d};
    // The error of the current is some roundings of its size.
    EXPECT_NEAR(figures[0], coil.high - coil.low, 64 * eps * U / R);
    EXPECT_NEAR(figures[1], coil.rms(), 64 * eps * U / R);
    EXPECT_NEAR(figures[2], d * U / R, 64 * eps * U / R);
    EXPECT_NEAR(figures[3], U * std::sqrt(d * (1 - d)), 1e-9) << "edges on a grid of 1e-12 s in 3e-3 s";
    // The textbook's straight lines give the ripple U d (1 - d) T/L. Their error is of second order in T/tau.
    const double triangle = U * d * (1 - d) * T / L, missed = T / tau * T / tau;
    EXPECT_NEAR(figures[0], triangle, triangle * missed);
    EXPECT_NEAR(figures[1], triangle / std::sqrt(12.0), triangle * missed);
  }
}

constexpr Signal powers[] = {Signal::supply_power, Signal::motor_power, Signal::mechanical_power,
                             Signal::load_power,   Signal::copper_loss, Signal::device_loss,
                             Signal::friction_loss};

Scenario loaded() {
  Scenario s = maxon_scenario(Mode::duty, 0.6);
  s.bridge = {.on_resistance_ohm = 0.02, .diode_drop_V = 0.7, .diode_resistance_ohm = 0.01};
  s.supply.resistance_ohm = 0.1;
  s.supply.capacitance_F = 1e-3;
  s.load.torque_Nm = 0.05;
  s.load.viscous_Nm_s = 2e-5;
  s.load.coulomb_Nm = 2e-3;
  s.duration_s = 50e-3;
  return s;
}

TEST(Measures, EnergiesAreTheBooks) {
  Scenario s = loaded();
  for (const Signal p : powers) {
    ask(s, measure(MetricKind::energy, p));
    ask(s, measure(MetricKind::mean, p));
    ask(s, over(MetricKind::energy, p, 0.0, 12.3456e-3));
    ask(s, over(MetricKind::energy, p, 12.3456e-3, 50e-3));
  }
  ask(s, measure(MetricKind::efficiency, Signal::current));
  const auto out = run(s);
  ASSERT_TRUE(out);
  const EnergyBook& book = *out->energy;
  const double should[] = {
      book.supplied, book.supplied - book.devices, book.air_gap, book.load, book.copper, book.devices,
      book.friction};
  // The gauge compensates its rounding. The mean is a plain sum, with one rounding per segment.
  const double bound = 16 * eps * book.moved, plain = static_cast<double>(out->segments) * eps * book.moved;
  const auto figure = [&](std::size_t n) { return out->comparisons[n].measured; };
  for (std::size_t n = 0; n < std::size(powers); ++n) {
    EXPECT_NEAR(figure(4 * n), should[n], bound) << fact_of(powers[n]).word;
    EXPECT_NEAR(figure(4 * n + 1) * s.duration_s, should[n], plain) << fact_of(powers[n]).word;
    EXPECT_NEAR(figure(4 * n + 2) + figure(4 * n + 3), should[n], 2 * bound) << fact_of(powers[n]).word;
    EXPECT_EQ(out->comparisons[4 * n].unit, "J");
  }
  // The friction of the load is work on the load. In the energy balance, all output counts as useful, except
  // the motor's friction.
  EXPECT_GT(figure(4 * std::size(powers)), (book.load + book.kinetic) / book.supplied + 0.005);
}

TEST(Measures, EfficiencyIsOutOverInWhicheverWayItFlows) {
  Scenario s = loaded();
  s.load.viscous_Nm_s = s.load.coulomb_Nm = 0.0;
  const auto efficiency = [](Scenario run_of) {
    ask(run_of, measure(MetricKind::efficiency, Signal::current));
    const auto out = run(run_of);
    EXPECT_TRUE(out);
    return std::pair(*out->energy, out->comparisons[0].measured);
  };
  const auto [motor, forward] = efficiency(s);
  EXPECT_NEAR(forward, (motor.load + motor.kinetic) / motor.supplied, 64 * eps);
  EXPECT_GT(forward, 0.3);
  // With complementary chopping, the mean voltage at this duty is below the back-EMF. Energy therefore
  // returns to the bus.
  s.pwm.chopping = control::Chopping::complementary;
  s.load.torque_Nm = 0.0;
  s.initial.speed_rad_s = 600.0;
  s.reference.value = 0.7;
  s.duration_s = 5e-3;
  const auto [brake, back] = efficiency(s);
  ASSERT_LT(brake.supplied, 0.0);
  EXPECT_NEAR(back, brake.supplied / (brake.load + brake.kinetic), 64 * eps);
  EXPECT_GT(back, 0.3);
  EXPECT_LT(back, 1.0);
  // The drive acts against the rotation of the motor. The energy of shaft and bus covers the losses.
  s.reference.value = -1.0;
  const auto [plug, none] = efficiency(s);
  ASSERT_GT(plug.supplied, 0.0);
  ASSERT_LT(plug.kinetic, 0.0);
  EXPECT_EQ(none, 0.0);
  // No energy flows, so the efficiency has no value.
  s.control.mode = Mode::off;
  s.supply = {};
  s.initial.speed_rad_s = 0.0;
  EXPECT_TRUE(std::isnan(efficiency(s).second));
}

TEST(Measures, SwitchingIsCountedPerSwitch) {
  Scenario s = locked(0.5);
  s.initial.angle_rad = 0.5 / 8;  // sector 0: T1 is chopped, T4 is on
  for (const Signal gate : {Signal::gate_T1, Signal::gate_T4, Signal::gate_T2}) {
    ask(s, over(MetricKind::switching_frequency, gate, 10.75 * T, 110.75 * T));
    ask(s, over(MetricKind::mean, gate, 10.75 * T, 110.75 * T));
  }
  ask(s, over(MetricKind::switching_frequency, Signal::current, 10.75 * T, 110.75 * T));
  ask(s, measure(MetricKind::maximum, Signal::duty));
  const std::vector<double> figures = figures_of(s);
  const double hertz = 1 / T;
  EXPECT_NEAR(figures[0], hertz, 8 * eps * hertz);
  EXPECT_NEAR(figures[1], 0.5, 1e-12 / T) << "edges on a grid of 1e-12 s";
  EXPECT_EQ(figures[2], 0.0);
  EXPECT_NEAR(figures[3], 1.0, 200 * eps);
  EXPECT_EQ(figures[4], 0.0);
  EXPECT_EQ(figures[5], 0.0);
  EXPECT_EQ(figures[6], figures[0]) << "one switch is all that is chopped";
  EXPECT_EQ(figures[7], 0.5);
}

TEST(Measures, DutyHasTheSignOfThePair) {
  for (const double duty : {0.5, -0.25}) {
    Scenario s = locked(duty);
    ask(s, measure(MetricKind::mean, Signal::duty));
    EXPECT_NEAR(figures_of(s)[0], duty, 1e3 * eps) << "a mean of a thousand segments";
  }
}

TEST(Measures, ErrorsLookAtTheEndOfEachLevelOrAtTheWindow) {
  Scenario s = current_square();  // levels of 5 ms, the last tenth is 0.5 ms
  s.reference.high = 2.0;
  s.reference.low = -10.0;  // the back-EMF prevents -10 A: the largest error is negative
  ask(s, measure(MetricKind::steady_error, Signal::current));
  ask(s, measure(MetricKind::largest_error, Signal::current));
  Measure m = measure(MetricKind::steady_error, Signal::current);
  m.tail = 0.5;
  ask(s, m);
  m = over(MetricKind::steady_error, Signal::current, 12e-3, 15e-3);
  ask(s, m);
  for (int n = 0; n < 4; ++n)
    for (const double tail : {0.5e-3, 2.5e-3})
      for (const MetricKind kind : {MetricKind::mean, MetricKind::maximum, MetricKind::minimum})
        ask(s, over(kind, Signal::current, (n + 1) * 5e-3 - tail, (n + 1) * 5e-3));
  ask(s, over(MetricKind::mean, Signal::current, 12e-3, 15e-3));
  ask(s, over(MetricKind::mean, Signal::current_error, 12e-3, 15e-3));
  const std::vector<double> figures = figures_of(s);
  double error[2] = {0.0, 0.0}, largest = 0.0;
  for (std::size_t n = 0; n < 4; ++n) {
    const double level = n % 2 == 0 ? 2.0 : -10.0;
    for (std::size_t t = 0; t < 2; ++t) {
      const double here = level - figures[4 + 6 * n + 3 * t];
      if (std::fabs(here) > std::fabs(error[t])) error[t] = here;
    }
    largest = std::max({largest, figures[5 + 6 * n] - level, level - figures[6 + 6 * n]});
  }
  // The ends of the windows are times of some 2e-2 s. The tolerance is their rounding relative to windows of
  // 5e-4 s.
  EXPECT_NEAR(figures[0], error[0], 1e-11);
  EXPECT_NEAR(figures[1], largest, 1e-11);
  EXPECT_NEAR(figures[2], error[1], 1e-11);
  EXPECT_EQ(figures[3], 2.0 - figures[28]);
  EXPECT_LT(figures[0], -0.5);
  EXPECT_NEAR(figures[3], figures[29], 64 * eps * 10.0) << "the reference is 2 A all through the window";
}

TEST(Measures, BandFiguresKeepToTheirWindow) {
  // The rotor turns backwards, and the back-EMF drives the current while the bridge freewheels. The current
  // is therefore outside the band until the rotor stops.
  Scenario s = maxon_scenario(Mode::current, 5.0);
  s.initial.speed_rad_s = -600.0;
  s.duration_s = 40e-3;
  s.control.current = {.type = CurrentLoopType::hysteresis, .band_A = 0.2};
  ask(s, measure(MetricKind::band_excess, Signal::current));
  for (int n = 0; n < 4; ++n)
    ask(s, over(MetricKind::band_excess, Signal::current, n * 10e-3, (n + 1) * 10e-3));
  const std::vector<double> figures = figures_of(s);
  EXPECT_GT(figures[0], 1.0) << "five bands";
  EXPECT_NEAR(figures[0], *std::max_element(figures.begin() + 1, figures.end()), 64 * eps * U / R);
  EXPECT_NEAR(figures[4], 0.0, 64 * eps * U / R) << "kept at the end";
}

TEST(Measures, SampledMagnitudesAreMagnitudes) {
  Scenario s = locked(0.5);
  s.duration_s = 5e-3;
  for (const Signal signal : {Signal::current_magnitude, Signal::current}) {
    Measure m = measure(MetricKind::final_value, signal);
    m.sampled = true;
    ask(s, m);
  }
  const std::vector<double> figures = figures_of(s);
  EXPECT_NEAR(figures[0], figures[1], 8 * eps * U / R);
  EXPECT_GT(figures[0], 11.0);
}

struct Refused {
  const char* where;
  std::function<void(Measure&)> make;
  std::function<void(Scenario&)> change = [](Scenario&) {};
};

TEST(Measures, WhatMakesNoSenseIsRefused) {
  const auto of = [](MetricKind kind, Signal signal) {
    return [=](Measure& m) { m.metric = kind, m.signal = signal; };
  };
  const Refused table[] = {
      {"compare[0].signal", of(MetricKind::energy, Signal::current)},
      {"compare[0].signal", of(MetricKind::efficiency, Signal::supply_power)},
      {"compare[0].signal", of(MetricKind::switching_frequency, Signal::speed)},
      {"compare[0].signal", of(MetricKind::mean, Signal::speed_error)},
      {"compare[0].signal", of(MetricKind::mean, Signal::position_reference)},
      {"compare[0].signal", of(MetricKind::mean, Signal::current_error),
       [](Scenario& s) { s.control.mode = Mode::duty, s.reference = {}; }},
      {"compare[0].level", of(MetricKind::rise_time, Signal::speed)},
      {"compare[0].level", of(MetricKind::steady_error, Signal::torque)},
      {"compare[0].frequency_Hz", of(MetricKind::thd, Signal::torque)},
      {"compare[0].frequency_Hz", of(MetricKind::thd, Signal::phase_a),
       [](Scenario& s) { s.load.locked = true; }},
      {"compare[0].frequency_Hz", [](Measure& m) { m.metric = MetricKind::thd, m.frequency_Hz = 49.0; }},
      {"compare[0].frequency_Hz", [](Measure& m) { m.frequency_Hz = 50.0; }},
      {"compare[0].tail", [](Measure& m) { m.tail = 0.5; }},
      {"compare[0].tail",
       [](Measure& m) { m.metric = MetricKind::largest_error, m.tail = 0.5, m.level = 1.0; }},
      {"compare[0].sampled",
       [](Measure& m) { m.metric = MetricKind::switching_frequency, m.sampled = true; }},
      {"compare[0].sampled",
       [](Measure& m) { m.metric = MetricKind::mean, m.signal = Signal::line_ab, m.sampled = true; }},
  };
  for (const Refused& row : table) {
    Scenario s = current_square();
    Measure m;
    row.make(m);
    row.change(s);
    ask(s, m);
    const base::Problems problems = check(s);
    ASSERT_EQ(problems.size(), 1u) << row.where << (problems.empty() ? "" : base::to_string(problems.back()));
    EXPECT_EQ(problems[0].where, row.where);
    EXPECT_FALSE(problems[0].limit.empty() || problems[0].cure.empty());
  }
  Scenario s = current_square();
  Measure m = measure(MetricKind::thd, Signal::torque);
  m.frequency_Hz = 50.0;  // one period in 20 ms
  ask(s, m);
  ask(s, measure(MetricKind::switching_frequency, Signal::gate_T5));
  EXPECT_TRUE(check(s).empty());
}

TEST(Measures, EachHasANameAndAUnit) {
  for (const auto& [word, kind, meaning, turning] : metric_choices) {
    const Measure m = measure(kind, Signal::copper_loss);
    EXPECT_GT(figure_name(m).size(), 9u) << word;
    EXPECT_FALSE(figure_unit(m).empty()) << word;
    const std::size_t unit = word.rfind('_');  // the unit of the figure is part of the word
    if (unit == std::string_view::npos) continue;
    for (const char* suffix : {"s", "A", "Hz", "J"}) {
      if (word.substr(unit + 1) == suffix) {
        EXPECT_EQ(figure_unit(m), suffix);
      }
    }
  }
  EXPECT_EQ(figure_name(measure(MetricKind::thd, Signal::line_ab)), "THD of line voltage a to b");
  EXPECT_EQ(figure_name(measure(MetricKind::efficiency, Signal::current)), "efficiency");
  EXPECT_EQ(figure_name(measure(MetricKind::energy, Signal::supply_power)), "energy from the bus");
  EXPECT_EQ(figure_name(measure(MetricKind::energy, Signal::copper_loss)), "energy of copper loss");
  EXPECT_EQ(figure_name(measure(MetricKind::switching_frequency, Signal::gate_T3)),
            "switching frequency of gate T3");
}

}  // namespace SIXSTEP_TEST_FILE

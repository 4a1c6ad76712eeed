// SPDX-License-Identifier: Apache-2.0
// Supplies of the general kernel are compared with closed forms (model.md 9). The kernel uses none of these
// formulas.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/general.hpp"

namespace SIXSTEP_TEST_FILE {

using namespace sixstep;
using namespace sixstep::testing;

constexpr double digits = 1e-12;

/// The rotor is locked. The bus supplies a resistor that is always on.
GeneralSetup loaded(const general::Supply& supply, double bus_V, double load_ohm) {
  GeneralSetup s;
  s.shaft.locked = true;
  s.supply = supply;
  s.supply.brake_ohm = load_ohm;
  s.supply.brake_on_V = -1e3;  // always on
  s.supply.brake_off_V = -2e3;
  s.start.bus_V = bus_V;
  return s;
}

TEST(GeneralSupply, ACapacitorWithAResistanceRingsWithTheWinding) {
  GeneralSetup s;
  s.shaft.locked = true;
  const double C = 50e-6, R = 2 * 0.515 + 0.3, L = 2 * 0.286e-3, U = 30;
  s.supply = {.V_0_V = 1, .R_b_ohm = 1, .C_F = C, .R_C_ohm = 0.3, .sinks = false};  // below the bus voltage,
                                                                                    // so the supply is
                                                                                    // blocked
  s.start.bus_V = U;
  HeldGeneral held(s, a_to_b());
  const double a = R / (2 * L), w = std::sqrt(1 / (L * C) - a * a);
  for (const double t : {2e-5, 1e-4, 2e-4}) {
    ASSERT_EQ(run_to(held, t), sim::Stop::end);
    const double i = U / (w * L) * std::exp(-a * t) * std::sin(w * t);
    const double v = U * std::exp(-a * t) * (std::cos(w * t) + a / w * std::sin(w * t));
    EXPECT_NEAR(held.plant().state().i[0], i, digits * 20) << t;
    EXPECT_NEAR(held.plant().more().capacitor.value, v, digits * 30) << t;
    EXPECT_NEAR(held.plant().state().bus, v - 0.3 * i, digits * 30) << t;
  }
}

TEST(GeneralSupply, ASourceTakesBackNoMoreThanItsLimit) {
  for (const double R_C : {0.0, 0.2}) {
    GeneralSetup s;
    s.shaft.locked = true;
    s.supply = {.V_0_V = 24, .R_b_ohm = 0.5, .C_F = 1e-3, .R_C_ohm = R_C, .sinks = false, .sink_A = 4};
    s.start.bus_V = 30;
    HeldGeneral held(s);
    // The current is 4 A until the bus voltage U_s is 24 + 0.5 * 4. Then the current decays exponentially.
    const double U_C = 26 + R_C * 4, level = (30 - U_C) * 1e-3 / 4, tau = (0.5 + R_C) * 1e-3;
    ASSERT_EQ(run_to(held, level / 2), sim::Stop::end);
    EXPECT_NEAR(held.plant().state().bus, 30 - 4 * level / 2 / 1e-3 - R_C * 4, digits * 30);
    ASSERT_EQ(run_to(held, level + 2e-4), sim::Stop::end);
    const double v_C = 24 + (U_C - 24) * std::exp(-2e-4 / tau);
    EXPECT_NEAR(held.plant().state().bus, v_C - R_C * (v_C - 24) / (0.5 + R_C), digits * 30);
  }
}

/// exp(A t) y for the three states y of a battery, computed by scaling and squaring of the series.
using Three = std::array<double, 3>;
using Matrix = std::array<Three, 3>;
Three after(const Matrix& A, const Three& y, double t) {
  const auto times = [](const Matrix& a, const Matrix& b) {
    Matrix c{};
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j)
        for (int k = 0; k < 3; ++k) c[i][j] += a[i][k] * b[k][j];
    return c;
  };
  Matrix E{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}}, term = E;
  const double h = t / 1024;
  for (int n = 1; n < 20; ++n) {
    term = times(term, A);
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) E[i][j] += (term[i][j] *= h / n);
  }
  for (int n = 0; n < 10; ++n) E = times(E, E);
  Three out{};
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) out[i] += E[i][j] * y[j];
  return out;
}

TEST(GeneralSupply, ABatterySagsAndRecoversAsItsCircuitDoes) {
  general::Battery battery{.open_circuit = {{0, 18}, {0.5, 22}, {1, 26}},
                           .capacity_C = 0.4,
                           .R_1_ohm = 0.2,
                           .C_1_F = 5e-3,
                           .charge = 0.9};
  const double R_b = 0.1, C = 1e-3, load = 2, OCV = 18 + 8 * 0.9;
  HeldGeneral held(
      loaded({.R_b_ohm = R_b, .C_F = C, .source = general::Source::battery, .battery = battery}, OCV, load));
  // The states are OCV (the open-circuit voltage, linear in the charge), v_1 and U_s. The current is i = (OCV
  // - v_1 - U_s)/R_b.
  const double per_Q = 8 / 0.4;
  const Matrix A{{{-per_Q / R_b, per_Q / R_b, per_Q / R_b},
                  {1 / (R_b * 5e-3), -1 / (R_b * 5e-3) - 1 / (0.2 * 5e-3), -1 / (R_b * 5e-3)},
                  {1 / (R_b * C), -1 / (R_b * C), -1 / (R_b * C) - 1 / (load * C)}}};
  for (const double t : {1e-4, 1e-3, 5e-3, 3e-2}) {
    ASSERT_EQ(run_to(held, t), sim::Stop::end);
    const Three y = after(A, {OCV, 0, OCV}, t);
    EXPECT_NEAR(held.plant().state().bus, y[2], 1e-11) << t;
    EXPECT_NEAR(held.plant().more().slow.value, y[1], 1e-11) << t;
    EXPECT_NEAR(held.plant().more().charge.value, (y[0] - 18) / 8, 1e-12) << t;
  }
  EXPECT_LT(held.plant().more().charge.value, 0.5) << "the middle point was passed";
}

/// The bus voltage U_s while a rectifier conducts, from the time `t_on` on. The rectifier's source is a sine
/// of amplitude V minus `drop`. U_s is the response of the RC circuit to this sine.
struct Conducting {
  double V, w, drop, R_b, R, C;
  double steady(double t) const {
    const double G = 1 / R_b + 1 / R, x = w * C, size = V / R_b / std::hypot(G, x);
    return size * std::sin(w * t - std::atan2(x, G)) - drop / R_b / G;
  }
  double at(double t, double t_on, double U_on) const {
    return steady(t) + (U_on - steady(t_on)) * std::exp(-(1 / R_b + 1 / R) / C * (t - t_on));
  }
};

TEST(GeneralSupply, ARectifierChargesAtTheTopsAndLeavesTheRestToTheCapacitor) {
  const double V = 34, w = 2 * base::pi * 50, drop = 1.6, R = 40, C = 1e-3;
  const Conducting law{V, w, drop, 0.5, R, C};
  general::Supply supply{.R_b_ohm = 0.5,
                         .C_F = C,
                         .sinks = false,
                         .source = general::Source::single_phase,
                         .mains = {.peak_V = V, .frequency_Hz = 50, .diode_drop_V = drop / 2}};
  HeldGeneral held(loaded(supply, 10, R));
  const auto root = [](double low, double high, auto&& f) {
    for (int n = 0; n < 200; ++n) (f((low + high) / 2) > 0 ? low : high) = (low + high) / 2;
    return low;
  };
  // whole microseconds are also whole picoseconds of the run's clock
  const auto whole_us = [](double t) { return std::round(t * 1e6) / 1e6; };
  const auto open = [&](double t) { return V * std::fabs(std::sin(w * t)) - drop; };
  double t_on = root(0, 5e-3, [&](double t) { return 10 * std::exp(-t / (R * C)) - open(t); });
  double U = 10 * std::exp(-t_on / (R * C));
  for (int pulse = 0; pulse < 3; ++pulse) {
    const double shift = pulse * 10e-3;
    const double t_off = root(t_on + 1e-5, shift + 10e-3,
                              [&](double t) { return open(t) - law.at(t - shift, t_on - shift, U); });
    const double t_mid = whole_us((t_on + t_off) / 2), t_after = whole_us(t_off + 2e-3);
    ASSERT_EQ(run_to(held, t_mid), sim::Stop::end);
    EXPECT_NEAR(held.plant().state().bus, law.at(t_mid - shift, t_on - shift, U), 1e-10) << pulse;
    const double U_off = law.at(t_off - shift, t_on - shift, U);
    t_on = root(t_off + 1e-5, shift + 15e-3,
                [&](double t) { return U_off * std::exp(-(t - t_off) / (R * C)) - open(t); });
    // Between two pulses of current, the open-circuit voltage is below the bus voltage. The root computed
    // above is the instant at which the rectifier conducts again.
    ASSERT_EQ(run_to(held, t_after), sim::Stop::end);
    EXPECT_NEAR(held.plant().state().bus, U_off * std::exp(-(t_after - t_off) / (R * C)), 1e-10) << pulse;
    U = U_off * std::exp(-(t_on - t_off) / (R * C));
  }
}

TEST(GeneralSupply, ThreePhasesLeaveTheRippleOfSixPulses) {
  const double V = 34, w = 2 * base::pi * 50;
  general::Supply supply{.R_b_ohm = 0.05,
                         .C_F = 10e-6,
                         .sinks = false,
                         .source = general::Source::three_phase,
                         .mains = {.peak_V = V, .frequency_Hz = 50, .diode_drop_V = 0.8}};
  HeldGeneral held(loaded(supply, V - 1.6, 10));
  for (const double t : {0.5e-3, 1.6e-3, 2.2e-3, 12.3e-3}) {
    ASSERT_EQ(run_to(held, t), sim::Stop::end);
    double open = 0;
    for (int k = 0; k < 6; ++k) open = std::max(open, V * std::cos(w * t - base::pi / 3 * k) - 1.6);
    EXPECT_NEAR(held.plant().state().bus, open * 10 / 10.05, 0.02) << t;  // even a small C causes a small lag
  }
}

}  // namespace SIXSTEP_TEST_FILE

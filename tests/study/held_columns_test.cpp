// SPDX-License-Identifier: Apache-2.0
// The columns of the plant's slow states contain the values at the row's instant, for any step of the slow
// solution.
#include <gtest/gtest.h>

#include <cmath>
#include <span>
#include <vector>

#include "sixstep/study/run/run.hpp"
#include "tests/support/general_scenarios.hpp"

namespace SIXSTEP_TEST_FILE {

using namespace sixstep;
using namespace sixstep::testing;
using study::Scenario;

std::vector<std::vector<double>> rows_of(const Scenario& s) {
  std::vector<std::vector<double>> rows;
  study::Listeners listeners;
  listeners.on_record = [&](std::span<const double> r) { rows.emplace_back(r.begin(), r.end()); };
  const auto out = study::run(s, listeners);
  EXPECT_TRUE(out) << base::to_string(out.problems()[0]);
  return rows;
}

Scenario cools_down(double step_s) {
  Scenario s = maxon_scenario(control::Mode::off, 0.0);
  s.duration_s = 1.0;
  s.load.locked = true;
  give_thermal_lines(s);
  s.heat.motor = true;
  s.heat.winding_degC = 120;
  s.heat.step_s = step_s;
  s.record.columns = {"winding_degC", "housing_degC"};
  s.record.grid_s = 0.07;
  return s;
}

/// Without losses, each thermal step is exact. The record must therefore not depend on the step.
TEST(HeldColumns, TemperaturesWithoutAPowerDoNotDependOnTheThermalStep) {
  const auto fine = rows_of(cools_down(1e-3));
  ASSERT_EQ(fine.size(), 15u);
  EXPECT_LT(fine.back()[1], 119.0) << "it cools down";
  for (const double step_s : {0.03, 0.1, 5.0}) {
    const auto rows = rows_of(cools_down(step_s));
    ASSERT_EQ(rows.size(), fine.size());
    for (std::size_t n = 0; n < rows.size(); ++n)
      for (std::size_t k = 1; k <= 2; ++k)
        EXPECT_NEAR(rows[n][k], fine[n][k], 1e-9) << step_s << " s, row " << n;
  }
}

/// The current is U/(2 R). At constant R, the power heats the winding up to each instant, even within a
/// thermal step.
TEST(HeldColumns, TemperaturesUnderAPowerAreThoseOfTheInstant) {
  const auto warmed = [](double step_s) {
    Scenario s = cools_down(step_s);
    s.control.mode = control::Mode::duty;
    s.reference.value = 1.0;
    s.supply.voltage_V = 3;
    s.heat.winding_degC = 25;
    s.duration_s = 0.5;
    return rows_of(s);
  };
  const auto fine = warmed(1e-3), coarse = warmed(0.2);
  ASSERT_EQ(fine.size(), coarse.size());
  const double rise = fine.back()[1] - 25;
  EXPECT_GT(rise, 0.2);
  // The resistance R of copper rises by 0.4 % per K. In the coarse run, R is constant over a step. This
  // changes the power by less than the rise of R.
  for (std::size_t n = 0; n < fine.size(); ++n)
    EXPECT_NEAR(coarse[n][1], fine[n][1], 0.00393 * rise * rise) << "row " << n;
}

/// The integral of C_1 dv_1/dt = i_src - v_1/R_1, from the recorded source current i_src, gives the recorded
/// voltage v_1.
TEST(HeldColumns, ABatterysRecoveringVoltageIsWhatItsCurrentMakesIt) {
  Scenario s = maxon_scenario(control::Mode::duty, 0.5);
  for (const AsksForGeneral& ask : asks_for_general)
    if (std::string_view(ask.what) == "battery") ask.make(s);
  s.supply.battery_recovery_ohm = 0.1;
  s.supply.battery_recovery_F = 0.05;
  s.duration_s = 0.02;
  s.record.columns = {"source_A", "battery_recovery_V", "battery_charge"};
  s.record.grid_s = 1e-6;
  double v = 0.0, last_A = 0.0;
  const auto rows = rows_of(s);
  ASSERT_EQ(rows.size(), 20001u);
  EXPECT_EQ(rows[0][2], 0.0);
  last_A = rows[0][1];
  for (std::size_t n = 1; n < rows.size(); ++n) {
    // The error of the trapezoidal rule is negligible: 1 us is short compared with R_1 C_1 = 5 ms, and with
    // the time constant of the bus capacitor.
    const double mean_A = (last_A + rows[n][1]) / 2, tau_s = 5e-3, h = 1e-6;
    v += h * (mean_A / 0.05 - v / tau_s) / (1 + h / (2 * tau_s));
    last_A = rows[n][1];
    ASSERT_NEAR(rows[n][2], v, 1e-4 * std::fabs(v) + 1e-6) << n;
  }
  EXPECT_GT(v, 0.01);
}

}  // namespace SIXSTEP_TEST_FILE

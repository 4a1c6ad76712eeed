// SPDX-License-Identifier: Apache-2.0
// Values that a program passes to an analysis have the same limits as values from a file.
#include <gmock/gmock.h>

#include <cmath>
#include <limits>

#include "sixstep/analysis/curve/curve.hpp"
#include "sixstep/analysis/verify/design_study.hpp"
#include "sixstep/analysis/verify/first_scenario.hpp"
#include "tests/support/bench.hpp"
#include "tests/support/scenarios.hpp"

namespace sixstep {
namespace SIXSTEP_TEST_FILE {

constexpr double inf = std::numeric_limits<double>::infinity();
const double hostile[] = {std::nan(""), inf, -inf, 1e308, -1e308, 5e-324};

std::string first(const base::Problems& problems) {
  return problems.empty() ? std::string() : to_string(problems.front());
}

/// Values within the limits give a drive or a refusal with a message, but never an invalid result.
TEST(Numbers, ADesignAtTheEndsOfTheTableIsUsableOrRefused) {
  for (const double voltage_V : {1e-6, 1e-3, 100.0, 1e3, 1e5})
    for (const double period_s : {1e-9, 30e-6, 1e-3, 1.0})
      for (const double inertia : {0.0, 1e9}) {
        analysis::DesignOrder order{
            .subject = {"maxon", testing::maxon_sheet(), std::nullopt}, .spec = {}, .tolerances = {}};
        order.spec.mode = control::Mode::current;
        order.spec.voltage_V = voltage_V;
        order.spec.period_s = period_s;
        order.spec.load_inertia_kg_m2 = inertia;
        const auto study = analysis::study_design(order);
        if (!study) {
          EXPECT_EQ(first(study.problems()).find("defect"), std::string::npos) << first(study.problems());
        } else {
          for (const std::vector<double>& column : study->trace.values)
            for (const double x : column) ASSERT_TRUE(std::isfinite(x)) << voltage_V << " " << period_s;
        }
      }
}

TEST(Numbers, OfABenchAreHeldToTheTable) {
  using analysis::CurveRequest;
  const auto refused = [](const char* where, auto&& give) {
    for (const double bad : hostile) {
      CurveRequest r{.sheet = testing::curve_sheet(), .bench = testing::maxon_bench()};
      give(r, bad);
      EXPECT_EQ(first(analysis::check(r)).rfind(where, 0), 0u)
          << where << " " << bad << first(analysis::check(r));
    }
  };
  refused("voltage_V", [](CurveRequest& r, double x) { r.bench.voltage_V = x; });
  refused("duty", [](CurveRequest& r, double x) { r.bench.duty = x; });
  refused("pwm_period_s", [](CurveRequest& r, double x) { r.bench.pwm_period_s = x; });
  refused("on_resistance_ohm", [](CurveRequest& r, double x) { r.bench.devices.R_on_ohm = x; });
  refused("diode_drop_V", [](CurveRequest& r, double x) { r.bench.devices.V_f_V = x; });
  refused("diode_resistance_ohm", [](CurveRequest& r, double x) { r.bench.devices.r_d_ohm = x; });
  CurveRequest many{.sheet = testing::curve_sheet(), .bench = testing::maxon_bench()};
  many.points = 2147483647;
  EXPECT_EQ(
      first(analysis::check(many)),
      "points = 2147483647 must be at most 200000; give fewer points; some hundred are enough for a page");
  many.points = 41;
  many.bench.voltage_V = 1e4;
  EXPECT_NE(first(analysis::check(many)).find("turns the field at 2.39e+06 electrical rad/s"),
            std::string::npos)
      << first(analysis::check(many));
}

TEST(Numbers, OfAFirstScenarioAreHeldToTheTable) {
  for (const double bad : hostile) {
    analysis::FirstScenarioSpec spec{.motor = "maxon", .sheet = testing::maxon_sheet()};
    for (const control::Mode mode : {control::Mode::duty, control::Mode::speed}) {
      spec.mode = mode;
      spec.voltage_V = bad;
      const auto s = analysis::first_scenario(spec);
      ASSERT_FALSE(s);
      EXPECT_EQ(first(s.problems()).rfind("voltage_V = ", 0), 0u) << first(s.problems());
    }
  }
}

}  // namespace SIXSTEP_TEST_FILE
}  // namespace sixstep

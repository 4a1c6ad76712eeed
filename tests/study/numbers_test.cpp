// SPDX-License-Identifier: Apache-2.0
// What a program, and not a file, gives to a study: the same table holds it.
#include <gmock/gmock.h>

#include <cmath>
#include <limits>

#include "sixstep/design/loops/drive_design.hpp"
#include "sixstep/study/check/check.hpp"
#include "sixstep/study/curve/curve.hpp"
#include "sixstep/study/measure/gauge.hpp"
#include "sixstep/study/run/run.hpp"
#include "sixstep/study/scenario/spread.hpp"
#include "sixstep/study/verify/design_study.hpp"
#include "sixstep/study/verify/first_scenario.hpp"
#include "tests/support/bench.hpp"
#include "tests/support/maxon.hpp"
#include "tests/support/scenarios.hpp"

namespace sixstep {
namespace {

using testing::maxon_scenario;

constexpr double inf = std::numeric_limits<double>::infinity();
const double hostile[] = {std::nan(""), inf, -inf, 1e308, -1e308, 5e-324};

std::string first(const base::Problems& problems) {
  return problems.empty() ? std::string() : to_string(problems.front());
}

TEST(Numbers, OfAScenarioMadeByAProgramAreHeldToTheirKeysRanges) {
  for (const double bad : hostile) {
    study::Scenario s = maxon_scenario(control::Mode::current, bad);
    EXPECT_EQ(first(study::check(s)).rfind("reference.value = ", 0), 0u) << bad;
    s = maxon_scenario(control::Mode::current, 1);
    s.load.times_s = {0, 1e-3};
    s.load.torques_Nm = {0, bad};
    EXPECT_EQ(first(study::check(s)).rfind("load.torques_Nm[1] = ", 0), 0u) << bad;
    s = maxon_scenario(control::Mode::current, 1);
    s.at.push_back({.time_s = 1e-3});
    s.at.push_back({.time_s = 2e-3, .supply = {.voltage_V = bad}});
    EXPECT_EQ(first(study::check(s)).rfind("at[1].supply.voltage_V = ", 0), 0u) << bad;
    s = maxon_scenario(control::Mode::current, 1);
    s.duration_s = bad;
    EXPECT_EQ(first(study::check(s)).rfind("duration_s = ", 0), 0u) << bad;
    EXPECT_FALSE(study::run(s));
  }
}

TEST(Numbers, OfALongListAFewAreTold) {
  study::Scenario s = maxon_scenario(control::Mode::current, 1);
  s.reference.values.assign(100'000, 1e308);
  EXPECT_EQ(study::check(s).size(), 5u);
}

TEST(Numbers, ASpreadStaysWithinWhatItsKeyMayBe) {
  study::Scenario s = maxon_scenario(control::Mode::current, 1);
  s.spread = {{.key = "supply.voltage_V", .relative = {}, .absolute = 1e6, .source = {}}};
  EXPECT_NE(first(study::check_spread(s)).find("lets supply.voltage_V reach"), std::string::npos);
}

TEST(Numbers, OfADesignsWishAreHeldToTheTable) {
  const design::MotorModel motor = *design::motor_model(testing::maxon_sheet());
  using Spec = design::DesignSpec;
  const auto refused = [&](const char* option, auto&& give) {
    for (const double bad : hostile) {
      Spec spec{.mode = control::Mode::speed};
      give(spec, bad);
      const auto d = design::design_drive(motor, spec);
      ASSERT_FALSE(d) << option << " " << bad;
      EXPECT_EQ(first(d.problems()).rfind(option, 0), 0u) << first(d.problems());
    }
  };
  refused("--voltage", [](Spec& w, double x) { w.voltage_V = x; });
  refused("--period", [](Spec& w, double x) { w.period_s = x; });
  refused("--settle", [](Spec& w, double x) { w.settle_s = x; });
  refused("--current-settle", [](Spec& w, double x) { w.current_settle_s = x; });
  refused("--damping", [](Spec& w, double x) { w.damping = x; });
  refused("--torque-limit", [](Spec& w, double x) { w.torque_limit_Nm = x; });
  refused("--load-inertia", [](Spec& w, double x) { w.load_inertia_kg_m2 = x; });
  refused("--bandwidth", [](Spec& w, double x) {
    w.method = design::GainMethod::cancellation;
    w.bandwidth_rad_s = x;
  });
}

/// What the table lets pass is a drive, or is refused in words; never a defect.
TEST(Numbers, ADesignAtTheEndsOfTheTableIsUsableOrRefused) {
  for (const double voltage_V : {1e-6, 1e-3, 100.0, 1e3, 1e5})
    for (const double period_s : {1e-9, 30e-6, 1e-3, 1.0})
      for (const double inertia : {0.0, 1e9}) {
        study::DesignOrder order{
            .subject = {"maxon", testing::maxon_sheet(), std::nullopt}, .spec = {}, .tolerances = {}};
        order.spec.mode = control::Mode::current;
        order.spec.voltage_V = voltage_V;
        order.spec.period_s = period_s;
        order.spec.load_inertia_kg_m2 = inertia;
        const auto study = study::study_design(order);
        if (!study) {
          EXPECT_EQ(first(study.problems()).find("defect"), std::string::npos) << first(study.problems());
        } else {
          for (const std::vector<double>& column : study->trace.values)
            for (const double x : column) ASSERT_TRUE(std::isfinite(x)) << voltage_V << " " << period_s;
        }
      }
}

TEST(Numbers, OfABenchAreHeldToTheTable) {
  using study::CurveRequest;
  const auto refused = [](const char* where, auto&& give) {
    for (const double bad : hostile) {
      CurveRequest r{.sheet = testing::curve_sheet(), .bench = testing::maxon_bench()};
      give(r, bad);
      EXPECT_EQ(first(study::check(r)).rfind(where, 0), 0u) << where << " " << bad << first(study::check(r));
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
      first(study::check(many)),
      "points = 2147483647 must be at most 200000; a page shows some hundred; each is simulated and kept");
  many.points = 41;
  many.bench.voltage_V = 1e4;
  EXPECT_NE(first(study::check(many)).find("lets the field turn at 2.39e+06 electrical rad/s"),
            std::string::npos)
      << first(study::check(many));
}

TEST(Numbers, OfAFirstScenarioAreHeldToTheTable) {
  for (const double bad : hostile) {
    study::FirstScenarioSpec spec{.motor = "maxon", .sheet = testing::maxon_sheet()};
    for (const control::Mode mode : {control::Mode::duty, control::Mode::speed}) {
      spec.mode = mode;
      spec.voltage_V = bad;
      const auto s = study::first_scenario(spec);
      ASSERT_FALSE(s);
      EXPECT_EQ(first(s.problems()).rfind("--voltage = ", 0), 0u) << first(s.problems());
    }
  }
}

/// NaN loses every comparison, so that the extremes of what else was seen would stand for a figure.
TEST(Numbers, AFigureOfWhichAPartIsNoNumberHasNoValue) {
  for (const study::MetricKind metric :
       {study::MetricKind::maximum, study::MetricKind::minimum, study::MetricKind::mean,
        study::MetricKind::rms, study::MetricKind::final_value, study::MetricKind::settling_time,
        study::MetricKind::reach_time})
    for (const double bad : {std::nan(""), inf, -inf}) {
      study::Measure m;
      m.metric = metric;
      study::Gauge whole(m, {0.0, 1.0}, 1.0, 0.0);
      study::Series line{};
      line[0] = 0.5;
      whole.part(line, 2, 0.0, 0.1);
      ASSERT_TRUE(whole.value());
      line[0] = bad;
      whole.part(line, 2, 0.1, 0.1);
      line[0] = 0.5;
      whole.part(line, 2, 0.2, 0.1);
      EXPECT_FALSE(whole.value()) << bad;
      m.sampled = true;
      study::Gauge sampled(m, {0.0, 1.0}, 1.0, 0.0);
      sampled.sample(0.1, 0.5);
      sampled.sample(0.2, bad);
      sampled.sample(0.3, 0.5);
      EXPECT_FALSE(sampled.value()) << bad;
    }
}

TEST(Numbers, OfASheetThatLiesAreRefused) {
  design::Sheet s = testing::maxon_sheet();
  s.inductance_mH->value = 1e6;  // 1 kH beside an ohm
  const auto slow = design::motor_model(s);
  ASSERT_FALSE(slow);
  EXPECT_NE(first(slow.problems()).find("no motor is above 100 s"), std::string::npos)
      << first(slow.problems());
  s = testing::maxon_sheet();
  s.pole_pairs = 100'000;
  EXPECT_FALSE(design::motor_model(s));
  for (const double bad : hostile) {
    s = testing::maxon_sheet();
    s.max_speed_rpm = {bad, "", ""};
    EXPECT_FALSE(design::motor_model(s)) << bad;
  }
}

}  // namespace
}  // namespace sixstep

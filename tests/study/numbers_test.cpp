// SPDX-License-Identifier: Apache-2.0
// A program can pass a scenario's values instead of a file. The same table of limits checks these values.
#include <gmock/gmock.h>

#include <cmath>
#include <limits>

#include "sixstep/design/loops/drive_design.hpp"
#include "sixstep/study/check/check.hpp"
#include "sixstep/study/measure/gauge.hpp"
#include "sixstep/study/run/run.hpp"
#include "sixstep/study/scenario/spread.hpp"
#include "tests/support/maxon.hpp"
#include "tests/support/scenarios.hpp"

namespace sixstep {
namespace SIXSTEP_TEST_FILE {

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
  refused("voltage_V", [](Spec& w, double x) { w.voltage_V = x; });
  refused("period_s", [](Spec& w, double x) { w.period_s = x; });
  refused("settle_s", [](Spec& w, double x) { w.settle_s = x; });
  refused("current_settle_s", [](Spec& w, double x) { w.current_settle_s = x; });
  refused("damping", [](Spec& w, double x) { w.damping = x; });
  refused("torque_limit_Nm", [](Spec& w, double x) { w.torque_limit_Nm = x; });
  refused("load_inertia_kg_m2", [](Spec& w, double x) { w.load_inertia_kg_m2 = x; });
  refused("bandwidth_rad_s", [](Spec& w, double x) {
    w.method = design::GainMethod::cancellation;
    w.bandwidth_rad_s = x;
  });
}

/// Every comparison with NaN is false. Without a check, the extremes of the other values would be returned as
/// the figure.
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
  s.inductance_mH->value = 1e6;  // 1 kH: a time constant far above 100 s
  const auto slow = design::motor_model(s);
  ASSERT_FALSE(slow);
  EXPECT_NE(first(slow.problems()).find("no motor has more than 100 s"), std::string::npos)
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

}  // namespace SIXSTEP_TEST_FILE
}  // namespace sixstep

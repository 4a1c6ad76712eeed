// SPDX-License-Identifier: Apache-2.0
// Recordings of existing machines are accepted. Values that no machine can have are refused. The message
// names the likely cause: a wrong unit of time or voltage, wrong pole pairs or a wrong probe factor.
#include "sixstep/analysis/identification/built_machines.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <string>

#include "sixstep/analysis/identification/hall/identify.hpp"
#include "sixstep/base/angle.hpp"
#include "tests/analysis/identification/drawn_emf.hpp"
#include "tests/analysis/identification/drilled.hpp"

namespace SIXSTEP_TEST_FILE {

using namespace sixstep;
using namespace sixstep::testing;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

/// The first problem as text; "" if there is none.
std::string told(const base::Problems& problems) { return problems.empty() ? "" : to_string(problems[0]); }

EmfTruth at(double frequency_Hz, double line_peak_V_s) {
  EmfTruth t;
  t.frequency_Hz = frequency_Hz;
  t.periods = 7.3;
  t.rows_per_period = 200.0;
  t.cos_part[1] = 1.0;
  t.flux_Vs = line_peak_V_s / std::sqrt(3.0);
  return t;
}

std::string measured(const EmfTruth& t, std::optional<int> pole_pairs) {
  analysis::EmfRequest request = drawn_record(t);
  request.pole_pairs = pole_pairs;
  const auto found = analysis::measure_emf(request);
  return found ? "" : told(found.problems());
}

/// line_V_s is the peak K_e between two lines, in V s per rad of the shaft.
struct Machine {
  const char* name;
  double line_V_s, rpm;
  int pole_pairs;
};
constexpr Machine machines[] = {
    {"micro motor of 2 mm", 0.05e-3, 60000, 1},
    {"25000 KV of a tiny drone", 0.38e-3, 20000, 6},
    {"turbo compressor", 1e-3, 500000, 1},
    {"maxon 251601", 33.5e-3, 6710, 8},
    {"hub motor by hand", 1.0, 30, 15},
    {"traction motor", 0.6, 12000, 4},
    {"wind generator, 3 MW at 690 V", 620, 15, 60},
    {"telescope's direct drive", 300, 0.02, 40},
};

TEST(BuiltMachines, WhatIsBuiltIsMeasured) {
  for (const Machine& m : machines) {
    const EmfTruth t = at(m.rpm / 60 * m.pole_pairs, m.line_V_s / m.pole_pairs);
    EXPECT_EQ(measured(t, m.pole_pairs), "") << m.name;
    EXPECT_EQ(measured(t, {}), "") << m.name;
  }
}

TEST(BuiltMachines, WhatIsBuiltByNobodyIsRefused) {
  // A back-EMF constant of 5e-6 V per 1000 rpm, and a shaft speed of 1e5 rad/s.
  const double krpm = 1000.0 * base::pi / 30.0, w = 1e5;
  EXPECT_THAT(
      measured(at(w / base::turn_rad, 5e-6 / krpm), 1),
      AllOf(
          HasSubstr(
              "time gives the shaft 954930 rpm with 1 pole pair, and no brushless machine is built for more than 600000"),
          HasSubstr("check the unit of time"), HasSubstr("more pole pairs")));
  EXPECT_THAT(
      measured(at(50, 5e-6 / krpm), 1),
      AllOf(HasSubstr("4.77e-05 mV s/rad, line peak at 50 Hz with 1 pole pair"), HasSubstr("less than 0.02"),
            HasSubstr("voltage is too small"), HasSubstr("probe's factor")));
  EXPECT_THAT(measured(at(25000, 1e-3), {}), AllOf(HasSubstr("25000 Hz"), Not(HasSubstr("pole pairs"))));
  EXPECT_THAT(measured(at(50, 2e3), {}),
              AllOf(HasSubstr("more than 1e+06"), HasSubstr("voltage is too great")));
  EXPECT_THAT(measured(at(1e-4, 1.0), 1), HasSubstr("0.006 rpm"));
}

TEST(BuiltMachines, TheBoundsAreThoseThatAreStated) {
  const auto speed = [](double rpm, int pairs) {
    return told(analysis::check_built_speed(rpm / 60 * std::max(pairs, 1), pairs));
  };
  for (const int pairs : {1, 2, 7}) {
    EXPECT_EQ(speed(0.999 * analysis::built_shaft_rpm.high, pairs), "");
    EXPECT_NE(speed(1.001 * analysis::built_shaft_rpm.high, pairs), "");
    EXPECT_EQ(speed(1.001 * analysis::built_shaft_rpm.low, pairs), "");
    EXPECT_NE(speed(0.999 * analysis::built_shaft_rpm.low, pairs), "");
  }
  EXPECT_EQ(told(analysis::check_built_speed(0.999 * analysis::most_built_Hz, 0)), "");
  EXPECT_NE(told(analysis::check_built_speed(1.001 * analysis::most_built_Hz, 0)), "");
  for (const int pairs : {0, 1, 7}) {
    const auto constant = [&](double mV_s) {
      return told(analysis::check_built_constant(1e-3 * mV_s / std::max(pairs, 1), 50.0, pairs));
    };
    EXPECT_EQ(constant(1.001 * analysis::built_line_mV_s.low), "");
    EXPECT_NE(constant(0.999 * analysis::built_line_mV_s.low), "");
    EXPECT_EQ(constant(0.999 * analysis::built_line_mV_s.high), "");
    EXPECT_NE(constant(1.001 * analysis::built_line_mV_s.high), "");
  }
}

/// The message names the true cause: with the right unit, the same recording is accepted.
TEST(BuiltMachines, ATimeInTheWrongUnitIsNamedAndItsCureHolds) {
  const EmfTruth right = at(50.0, 2e-3);
  EXPECT_EQ(measured(right, 1), "");
  for (const double factor : {1e-6, 1e-3, 1e6}) {
    analysis::EmfRequest request = drawn_record(right);
    request.pole_pairs = 1;
    for (double& t : request.record.t_s) t *= factor;
    const auto found = analysis::measure_emf(request);
    ASSERT_FALSE(found) << factor;
    EXPECT_THAT(told(found.problems()), HasSubstr("time")) << factor;
    for (double& t : request.record.t_s) t /= factor;
    EXPECT_TRUE(analysis::measure_emf(request)) << factor;
  }
}

/// The same limits apply to logs of Hall lines. The edges determine the speed, the voltages determine the
/// constant.
TEST(BuiltMachines, ALogOfHallLinesInAWrongUnitIsRefused) {
  HallTruth truth = drilled();
  EXPECT_TRUE(analysis::identify(drawn_log(truth).log));
  truth.voltages = analysis::RecordedVoltages::lines;
  const analysis::HallLog right = drawn_log(truth).log;
  ASSERT_TRUE(analysis::identify(right));
  analysis::HallLog log = right;
  for (double& t : log.t_s) t *= 1e-4;  // ten electrical turns a second become a hundred thousand
  EXPECT_THAT(told(analysis::identify(log).problems()),
              AllOf(HasSubstr("100000 Hz"), HasSubstr("unit of time")));
  log = right;
  for (std::vector<double>& channel : log.u_V)
    for (double& u : channel) u *= 1e6;
  EXPECT_THAT(
      told(analysis::identify(log).problems()),
      AllOf(HasSubstr("no brushless machine is built with more than"), HasSubstr("voltage is too great")));
}

}  // namespace SIXSTEP_TEST_FILE

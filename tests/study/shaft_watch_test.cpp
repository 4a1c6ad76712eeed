// SPDX-License-Identifier: Apache-2.0
// A drive that monitors its encoder or resolver names the fault at the time that the closed form gives. If
// the sensor is sound, the drive reports no fault, with any allowed errors and noise. An external drive turns
// the shaft at constant speed, so that angles have a closed form.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "sixstep/base/angle.hpp"
#include "sixstep/study/check/check.hpp"
#include "sixstep/study/run/run.hpp"
#include "tests/support/figures.hpp"
#include "tests/support/scenarios.hpp"

namespace SIXSTEP_TEST_FILE {

using namespace sixstep;
using namespace sixstep::testing;
using namespace sixstep::study;
using ::testing::HasSubstr;

constexpr double w = turned_rad_s, theta_0 = turned_from_rad, deg = base::pi / 180;

/// The time, in s, at which the shaft passes an angle in its first turn.
double time_at(double angle_deg) { return (angle_deg * deg - theta_0) / w; }

Scenario turned(RotorSensing rotor, double to_deg) {
  Scenario s = turned_by(rotor, time_at(to_deg));
  s.sensors.capture_Hz = 48e6;
  s.sensors.resolver.excitation_Hz = 0.5 / s.pwm.period_s;
  s.sensors.resolver.bandwidth_Hz = 500;
  return s;
}

At at_angle(double angle_deg) {
  At at;
  at.time_s = time_at(angle_deg);
  return at;
}

Scenario read_by(rig::ResolverReading reading, double to_deg) {
  Scenario s = turned(RotorSensing::resolver, to_deg);
  s.sensors.resolver.reading = reading;
  return s;
}

constexpr rig::ResolverReading readings[] = {rig::ResolverReading::sampled, rig::ResolverReading::tracking};

std::string fault_of(const Outcome& out) { return out.fault ? to_string(*out.fault) : "none"; }

// Without the cosine, the sum of squares is only the square of the sine. It falls below one half at 45
// degrees before the sine is zero.
TEST(ShaftWatch, ABrokenWindingIsNamedWhereHalfTheSquareIsLost) {
  for (const auto reading : readings) {
    Scenario s = read_by(reading, 200);
    s.at.push_back(at_angle(80));
    s.at.back().sensors.broken_winding = Winding::cosine;
    const Outcome out = outcome_of(s);
    EXPECT_THAT(fault_of(out), HasSubstr("cosine winding has no voltage"));
    // One count of the converter shifts the instant at which the square falls below its limit. The fault
    // needs two results, and each result is half a period of the excitation late.
    EXPECT_NEAR(out.simulated_s, time_at(135), 2.5 * s.pwm.period_s + 1.25 / 2048 / w);
    s.at.back().sensors.broken_winding = Winding::sine;
    const Outcome sine = outcome_of(s);
    EXPECT_THAT(fault_of(sine), HasSubstr("the sine winding has no voltage"));
    EXPECT_NEAR(sine.simulated_s, time_at(80), 3 * s.pwm.period_s)
        << "at 80 degrees the cosine shows 3 % of the square";
  }
}

TEST(ShaftWatch, ExcitationIsNamedByThePartThatIsLeft) {
  struct Case {
    double part;
    const char* text;
  };
  // Half of the square is an amplitude of 0.707. A square that is larger by a quarter is an amplitude of
  // 1.118.
  const Case cases[] = {{0.0, "excitation is lost"},
                        {0.5, "50 % of its amplitude, less"},
                        {0.69, "69 % of its amplitude, less"},
                        {0.73, "none"},
                        {1.1, "none"},
                        {1.2, "120 % of its amplitude, more"}};
  for (const auto reading : readings)
    for (const Case& c : cases) {
      Scenario s = read_by(reading, 100);
      s.at.push_back(at_angle(40));
      s.at.back().sensors.excitation = c.part;
      const Outcome out = outcome_of(s);
      EXPECT_THAT(fault_of(out), HasSubstr(c.text)) << c.part;
      if (out.fault) {
        EXPECT_NEAR(out.simulated_s, time_at(40), 3 * s.pwm.period_s);
      }
    }
}

// While the signal is missing, the loop keeps its speed. Afterwards, the angle follows the windings again.
TEST(ShaftWatch, ADriveThatDoesNotLookGoesOn) {
  for (const auto reading : readings) {
    Scenario s = read_by(reading, 300);
    s.sensors.watched = false;
    s.at.push_back(at_angle(60));
    s.at.back().sensors.excitation = 0.0;
    s.at.push_back(at_angle(90));
    s.at.back().sensors.excitation = 1.0;
    s.at.push_back(at_angle(120));
    s.at.back().sensors.broken_winding = Winding::sine;
    s.at.push_back(at_angle(150));
    s.at.back().sensors.broken_winding = Winding::whole;
    const Outcome out = outcome_of(s);
    EXPECT_EQ(fault_of(out), "none");
    EXPECT_NEAR(out.simulated_s, s.duration_s, 1e-9);
  }
}

// The resolver has the largest allowed errors and noise, and turns by more than a turn. The drive must not
// report a loss before the excitation fails.
TEST(ShaftWatch, AWholeResolverIsNeverLost) {
  for (const auto reading : readings)
    for (const bool calibrated : {false, true}) {
      if (calibrated && reading == rig::ResolverReading::tracking) continue;
      Scenario s = read_by(reading, 700);
      Resolver& r = s.sensors.resolver;
      r.imbalance = 0.3;
      r.quadrature_deg = 25;
      r.phase_deg = 20;
      r.sine_phase_deg = -35;
      r.noise_V = 0.02 * r.amplitude_V;
      r.calibrated = calibrated;
      EXPECT_EQ(fault_of(outcome_of(s)), "none");
      s.at.push_back(at_angle(400));
      s.at.back().sensors.excitation = 0.0;
      EXPECT_THAT(fault_of(outcome_of(s)), HasSubstr("excitation is lost"));
    }
}

/// The number N in the message "came with N counts missing".
int missing_of(const Outcome& out) {
  const std::string text = fault_of(out), before = "came with ";
  const std::size_t at = text.find(before);
  return at == std::string::npos ? 0 : std::atoi(text.c_str() + at + before.size());
}

// At the index, the drive computes how many counts are missing since the line became stuck, in the shorter
// direction. It reports the fault at the next sample.
TEST(ShaftWatch, AStuckLineIsNamedByTheNextIndex) {
  for (const EncoderLine line : {EncoderLine::A, EncoderLine::B})
    for (const double stuck_deg : {60.0, 250.0}) {
      Scenario s = turned(RotorSensing::encoder, 500);
      s.at.push_back(at_angle(stuck_deg));
      s.at.back().sensors.encoder_line = AtEncoderLine{line, EncoderLevel::high};
      const Outcome out = outcome_of(s);
      const double passed = (360 - stuck_deg) / 360 * 4096;
      EXPECT_NEAR(missing_of(out), passed <= 2048 ? passed : passed - 4096, 3) << fault_of(out);
      EXPECT_GE(out.simulated_s, time_at(360));
      EXPECT_LT(out.simulated_s, time_at(360) + 1.01 * s.pwm.period_s);
    }
}

// A disturbance causes an index that is too early by the rest of the turn. If this error is less than a
// sector, the drive corrects its count, although the count was right.
TEST(ShaftWatch, AFalseIndexIsNamedWhereItIsMoreThanASectorOff) {
  Scenario s = turned(RotorSensing::encoder, 340);
  s.at.push_back(at_angle(250));
  s.at.back().sensors.false_index = true;
  Outcome out = outcome_of(s);
  EXPECT_NEAR(missing_of(out), (360 - 250.0) / 360 * 4096, 2);
  s.at.back() = at_angle(355);  // a sector is 7.5 degrees of the shaft
  s.at.back().sensors.false_index = true;
  s.duration_s = time_at(358);
  EXPECT_EQ(fault_of(outcome_of(s)), "none");
  // At the true index, the same number of counts is wrong in the other direction, and the drive corrects
  // them.
  s.duration_s = time_at(362);
  EXPECT_EQ(fault_of(outcome_of(s)), "none");
}

TEST(ShaftWatch, EdgesThatAreMissedAreMendedWithinASector) {
  for (const int missed : {60, 120}) {  // a sector has 85.3 counts
    Scenario s = turned(RotorSensing::encoder, 380);
    s.at.push_back(at_angle(200));
    s.at.back().sensors.missed_edges = missed;
    EXPECT_EQ(missing_of(outcome_of(s)), missed > 85 ? missed : 0);
  }
}

TEST(ShaftWatch, AnIndexThatIsLostMendsNothing) {
  Scenario s = turned(RotorSensing::encoder, 780);
  s.at.push_back(at_angle(100));
  s.at.back().sensors.encoder_line = AtEncoderLine{EncoderLine::Z, EncoderLevel::low};
  s.at.push_back(at_angle(200));
  s.at.back().sensors.missed_edges = 120;
  s.at.push_back(at_angle(500));
  s.at.back().sensors.encoder_line = AtEncoderLine{EncoderLine::Z, EncoderLevel::whole};
  const Outcome out = outcome_of(s);
  EXPECT_EQ(missing_of(out), 120);
  EXPECT_NEAR(out.simulated_s, time_at(720), 1.01 * s.pwm.period_s) << "the second index, not the first";
}

TEST(ShaftWatch, WhatCannotBeIsRefused) {
  const auto refused = [](RotorSensing rotor, auto&& change) -> std::string {
    Scenario s = turned(rotor, 90);
    s.at.push_back(at_angle(40));
    change(s.at.back().sensors);
    const base::Problems problems = check(s);
    return problems.empty() ? "nothing" : to_string(problems[0]);
  };
  const auto line = [](AtSensors& at) { at.encoder_line = AtEncoderLine{}; };
  const auto index = [](AtSensors& at) { at.false_index = true; };
  const auto excitation = [](AtSensors& at) { at.excitation = 0.5; };
  EXPECT_EQ(refused(RotorSensing::encoder, line), "nothing");
  EXPECT_EQ(refused(RotorSensing::encoder, index), "nothing");
  EXPECT_EQ(refused(RotorSensing::resolver, excitation), "nothing");
  EXPECT_THAT(refused(RotorSensing::resolver, line), HasSubstr("applies to an encoder"));
  EXPECT_THAT(refused(RotorSensing::absolute, index), HasSubstr("applies to an encoder"));
  EXPECT_THAT(refused(RotorSensing::encoder, excitation), HasSubstr("applies to a resolver"));
  EXPECT_THAT(refused(RotorSensing::resolver, [](AtSensors& at) { at.excitation = 2.5; }),
              HasSubstr("must lie in 0 to 2"));
}

}  // namespace SIXSTEP_TEST_FILE

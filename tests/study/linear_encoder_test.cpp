// SPDX-License-Identifier: Apache-2.0
// A linear motor with a scale of lines. The position of the drive is exact within a quarter of a line pitch.
// The tests include refusals.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "sixstep/base/angle.hpp"
#include "sixstep/control/commutation.hpp"
#include "sixstep/rig/rotor_decoder.hpp"
#include "sixstep/study/check/check.hpp"
#include "sixstep/study/compile/shaft_sensor.hpp"
#include "tests/support/figures.hpp"
#include "tests/support/linear.hpp"
#include "tests/support/scenarios.hpp"

namespace SIXSTEP_TEST_FILE {

using namespace sixstep;
using namespace sixstep::testing;
using namespace sixstep::study;
using ::testing::HasSubstr;

constexpr double pitch_m = 20e-6, pole_pitch_m = 12e-3, p = base::pi / pole_pitch_m;

/// The linear version of the cascade's motor. One period of the magnets is 24 mm, which is 1200 lines of the
/// scale.
Scenario on_a_scale(Scenario s) {
  s.sheet = unrolled(s.sheet, pole_pitch_m / (base::pi / 8));
  s.sheet.pole_pitch_mm->value = 1e3 * pole_pitch_m;
  s.pwm.commutation = CommutationAt::sample;
  s.sensors.rotor = RotorSensing::encoder;
  s.sensors.capture_Hz = 48e6;
  s.sensors.encoder.pitch_mm = 1e3 * pitch_m;
  return s;
}

/// The factor from metres to the position reading. One metre of the linear motor corresponds to one radian of
/// the rotary motor, and the reading is in degrees.
constexpr double deg = 180 / base::pi;

// At each sample, the position is the position of the present quarter line. The speed is measured between two
// edges, and the sector is the sector of the magnets.
TEST(LinearEncoder, TellsAPlaceToAQuarterOfItsPitch) {
  const Scenario s = on_a_scale(cascade());
  for (const double v : {0.11, -0.73}) {
    rig::SensorsConfig config;
    config.shaft = shaft_sensor_config(s);
    config.period_s = s.pwm.period_s;
    config.capture_Hz = 1e8;
    const double x_0 = v > 0 ? -3e-3 : 4e-3, h = s.pwm.period_s;  // the motion passes the index
    const auto slide = [&](double t) {
      const double e = p * (x_0 + v * t);
      const auto sector = static_cast<std::int64_t>(std::floor(e / base::sector_rad));
      return plant::ShaftAngle<double>{sector, e - static_cast<double>(sector) * base::sector_rad, 1};
    };
    rig::ShaftPorts ports(config.shaft, config.capture_Hz, 0, slide(0));
    rig::RotorDecoder<double> decoder(config, {}, slide(0));
    int indexes = 0;
    for (int n = 0; n < 4000; ++n) {
      const double t = n * h, x = x_0 + v * t;
      control::Measurement<double> m{};
      rig::Sample sample;
      sample.at = sim::to_instant(t);
      rig::ShaftPorts copy = ports;
      indexes += copy.index_passed();
      decoder.sense(m, sample, ports, static_cast<std::uint32_t>(std::floor(t * config.capture_Hz)));
      // Angles have steps of 2^-16 of a period of the magnets. Angles and quarters are rounded down.
      const double below = x - m.position_deg / deg, unit = 2 * pole_pitch_m / 65536;
      ASSERT_GT(below, -1e-12) << n;
      ASSERT_LT(below, pitch_m / 4 + unit + 1e-12) << n;
      if (n > 20) {
        // The bound is one timer count divided by the time between the last edges of two samples. This time
        // is at least the sampling period minus the time between two edges.
        const double apart = h - pitch_m / 4 / std::fabs(v);
        if (apart > 0) {
          ASSERT_NEAR(m.speed_rad_s, v, std::fabs(v) * 2 / (apart * config.capture_Hz)) << n;
        }
      }
      // 800 quarter lines are a sixth of the period of the magnets.
      const double quarter = std::floor((m.position_deg / deg + 0.999 * unit) / (pitch_m / 4));
      const auto seen = static_cast<int>(std::floor(quarter / 800));
      EXPECT_EQ(control::sector_of_hall(m.hall), (seen % 6 + 6) % 6) << n;
      plant::Expansion<double> y;
      y.degree = 1;
      y.h = h;
      y.x[0] = slide(t).x;
      y.x[1] = p * v * h;
      y.w[0] = v;
      y.w[1] = 0;
      ports.follow(rig::ShaftMotion<double>{y, slide(t).sector, 1, 1.0, sim::to_instant(t),
                                            sim::to_instant(t + h), sim::to_instant(t + h)});
    }
    EXPECT_EQ(indexes, 1) << "a scale has one, whatever the magnets' period";
    EXPECT_FALSE(decoder.found().lost());
  }
}

TEST(LinearEncoder, HoldsAPosition) {
  Scenario s = on_a_scale(cascade(0.4));
  const double r = pole_pitch_m / (base::pi / 8);
  s.control.mode = control::Mode::position;
  s.control.speed.torque_limit_Nm = 0.78 / r;
  s.control.position.gain_rad_s_per_deg = 1;
  s.reference.value = 0.05 * deg;  // 50 mm
  s.load.coulomb_Nm = 0.002 / r;
  ask(s, measure(MetricKind::final_value, Signal::position));
  const Outcome out = outcome_of(s);
  EXPECT_EQ(out.comparisons[0].unit, "mm");
  EXPECT_NEAR(out.comparisons[0].measured, 50, 2 * 1e3 * pitch_m / 4);
}

TEST(LinearEncoder, WhatCannotBeIsRefused) {
  const auto refused = [](auto&& change) -> std::string {
    Scenario s = on_a_scale(cascade());
    change(s);
    const base::Problems problems = check(s);
    return problems.empty() ? "nothing" : to_string(problems[0]);
  };
  EXPECT_EQ(refused([](Scenario&) {}), "nothing");
  EXPECT_THAT(refused([](Scenario& s) { s.sensors.encoder.pitch_mm.reset(); }), HasSubstr("is missing"));
  EXPECT_THAT(refused([](Scenario& s) { s.sensors.encoder.pitch_mm = 0.021; }), HasSubstr("whole number"));
  EXPECT_THAT(refused([](Scenario& s) { s.sensors.encoder.lines = 500; }), HasSubstr("pitch_mm instead"));
  EXPECT_THAT(refused([](Scenario& s) { s.sensors.shaft = SensorShaft::load; }),
              HasSubstr("this motor is linear"));
  for (const RotorSensing rotor : {RotorSensing::absolute, RotorSensing::resolver})
    EXPECT_THAT(refused([rotor](Scenario& s) { s.sensors.rotor = rotor; }),
                HasSubstr("needs a turning shaft"));
  Scenario turning = cascade();
  turning.pwm.commutation = CommutationAt::sample;
  turning.sensors.rotor = RotorSensing::encoder;
  turning.sensors.encoder.pitch_mm = 0.02;
  EXPECT_THAT(to_string(check(turning)[0]), HasSubstr("this motor is rotary"));
}

}  // namespace SIXSTEP_TEST_FILE

// SPDX-License-Identifier: Apache-2.0
// Encoders and resolvers in whole runs. The drive uses the values of their decoders, and its results are
// compared with the results of ideal sensors. Impossible scenarios are refused.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "sixstep/base/angle.hpp"
#include "sixstep/rig/rotor_decoder.hpp"
#include "sixstep/study/check/check.hpp"
#include "sixstep/study/compile/shaft_sensor.hpp"
#include "sixstep/study/run/run.hpp"
#include "tests/support/figures.hpp"
#include "tests/support/product_scenarios.hpp"

namespace SIXSTEP_TEST_FILE {

using namespace sixstep;
using namespace sixstep::testing;
using namespace sixstep::study;
using control::Mode;
using ::testing::HasSubstr;

constexpr RotorSensing kinds[] = {RotorSensing::encoder, RotorSensing::absolute, RotorSensing::resolver};

Scenario sensed(Scenario s, RotorSensing rotor) {
  s.sensors.rotor = rotor;
  s.pwm.commutation = CommutationAt::sample;
  s.sensors.absolute = {.bits = 17, .latency_s = 5e-6};
  s.sensors.resolver.excitation_Hz = 0.5 / s.pwm.period_s;
  return s;
}

TEST(ShaftSensors, ACascadeRunsOnEachAsOnIdealOnes) {
  Scenario s = cascade(40e-3);
  s.pwm.commutation = CommutationAt::sample;
  ask(s, measure(MetricKind::final_value, Signal::speed));
  ask(s, measure(MetricKind::rms, Signal::current));
  const Outcome ideal = outcome_of(s);
  for (const RotorSensing kind : kinds) {
    const Outcome out = outcome_of(sensed(s, kind));
    EXPECT_NE(out.digest, ideal.digest);
    EXPECT_NEAR(out.comparisons[0].measured, ideal.comparisons[0].measured, 1.0) << static_cast<int>(kind);
    // The 12-bit converter of the resolver adds noise to the current.
    EXPECT_NEAR(out.comparisons[1].measured / ideal.comparisons[1].measured, 1, 0.35)
        << static_cast<int>(kind);
  }
}

TEST(ShaftSensors, APositionIsHeldToTheirResolution) {
  for (const RotorSensing kind : kinds) {
    Scenario s = cascade(0.6);
    s.control.mode = Mode::position;
    s.control.position.gain_rad_s_per_deg = 0.2;
    s.reference.value = 400;  // more than one turn
    s.load.coulomb_Nm = 0.002;
    ask(s, measure(MetricKind::final_value, Signal::position));
    EXPECT_NEAR(outcome_of(sensed(s, kind)).comparisons[0].measured, 400, 0.5) << static_cast<int>(kind);
  }
}

TEST(ShaftSensors, InFixedPointToo) {
  for (const RotorSensing kind : kinds) {
    Scenario s = cascade(40e-3);
    s.control.arithmetic = Arithmetic::q31;
    s.control.full_scale = {100, 80, 1600, 7200};
    ask(s, measure(MetricKind::final_value, Signal::speed));
    EXPECT_NEAR(outcome_of(sensed(s, kind)).comparisons[0].measured, 100, 2.0) << static_cast<int>(kind);
  }
}

TEST(ShaftSensors, AnEncoderWithoutItsIndexIsCommutatedByTheProbesUntilItPasses) {
  Scenario s = sensed(cascade(0.15), RotorSensing::encoder);
  s.sensors.encoder.referenced = false;
  s.initial.angle_rad = 1.0;  // 5.3 rad before the index
  ask(s, measure(MetricKind::final_value, Signal::speed));
  EXPECT_NEAR(outcome_of(s).comparisons[0].measured, 100, 1.0);
}

// The values of the decoders for a rotor at constant speed, sample by sample.
TEST(RotorDecoders, TellSpeedAngleAndSectorOfASteadyRotor) {
  for (const RotorSensing kind : kinds)
    for (const double w : {20.0, -300.0}) {
      Scenario s = sensed(cascade(), kind);
      const double T = s.pwm.period_s, h = T;
      rig::SensorsConfig config;
      config.shaft = shaft_sensor_config(s);
      config.period_s = T;
      config.capture_Hz = 1e8;
      const auto shaft = [&](double t) {
        const double e = 8 * (0.2 + w * t);
        const auto sector = static_cast<std::int64_t>(std::floor(e / base::sector_rad));
        return plant::ShaftAngle<double>{sector, e - static_cast<double>(sector) * base::sector_rad, 8};
      };
      rig::ShaftPorts ports(config.shaft, config.capture_Hz, 0, shaft(0));
      rig::RotorDecoder<double> decoder(config, {}, shaft(0));
      int wrong_sectors = 0;
      for (int n = 0; n < 3000; ++n) {
        const double t = n * T;
        control::Measurement<double> m{};
        rig::Sample sample;
        sample.at = sim::to_instant(t);
        sample.number = static_cast<std::uint64_t>(n);
        sample.shaft = shaft(t);
        decoder.sense(m, sample, ports, static_cast<std::uint32_t>(std::floor(t * config.capture_Hz)));
        if (n > 1500) {
          EXPECT_NEAR(m.speed_rad_s, w, std::fabs(w) * 2e-2 + 0.3) << static_cast<int>(kind) << " " << n;
          EXPECT_NEAR(m.position_deg, (0.2 + w * t) * 180 / base::pi, 0.2) << static_cast<int>(kind);
          const auto sector = static_cast<int>((sample.shaft.sector % 6 + 6) % 6);
          wrong_sectors += control::sector_of_hall(m.hall) != sector;
        }
        plant::Expansion<double> y;
        y.degree = 1;
        y.h = h;
        y.x[0] = sample.shaft.x;
        y.x[1] = 8 * w * h;
        y.w[0] = w;
        y.w[1] = 0;
        ports.follow(rig::ShaftMotion<double>{y, sample.shaft.sector, 8, 1.0, sim::to_instant(t),
                                              sim::to_instant(t + T), sim::to_instant(t + T)});
      }
      // The decoders show a sector edge up to 0.2 degrees late. A sector has 7.5 degrees.
      EXPECT_LT(wrong_sectors, 1500 * 0.2 / 7.5) << static_cast<int>(kind) << " at " << w;
    }
}

/// Unequal windings shift the angle by a closed form. A calibrated drive subtracts this shift.
TEST(RotorDecoders, TakeOffWhatAResolverIsKnownToBeWrongBy) {
  constexpr double deg = base::pi / 180;
  for (const bool calibrated : {false, true})
    for (int n = 0; n < 24; ++n) {
      Scenario s = sensed(cascade(), RotorSensing::resolver);
      s.sensors.resolver.imbalance = 0.05;
      s.sensors.resolver.quadrature_deg = 2.0;
      s.sensors.resolver.phase_deg = 10.0;
      s.sensors.resolver.sine_phase_deg = -20.0;
      s.sensors.resolver.calibrated = calibrated;
      rig::SensorsConfig config;
      config.shaft = shaft_sensor_config(s);
      config.period_s = s.pwm.period_s;
      config.capture_Hz = 1e8;
      const double theta = (n + 0.37) * 2 * base::pi / 24, e = 8 * theta;
      const auto sector = static_cast<std::int64_t>(std::floor(e / base::sector_rad));
      const plant::ShaftAngle<double> at{sector, e - static_cast<double>(sector) * base::sector_rad, 8};
      rig::ShaftPorts ports(config.shaft, config.capture_Hz, 0, at);
      rig::RotorDecoder<double> decoder(config, {}, at);
      control::Measurement<double> m{};
      for (int k = 0; k < 1500; ++k) {
        rig::Sample sample;
        sample.at = sim::to_instant(k * s.pwm.period_s);
        sample.number = static_cast<std::uint64_t>(k);
        sample.shaft = at;
        decoder.sense(m, sample, ports, 0);
      }
      const double shown = std::atan2(1.05 * std::cos(20 * deg) * std::sin(theta + 2 * deg),
                                      std::cos(10 * deg) * std::cos(theta));
      const double error_deg = std::remainder(shown - theta, 2 * base::pi) / deg;
      // One count of 12 bits is 0.035 degrees if the signal uses 0.8 of the range.
      EXPECT_NEAR(m.position_deg - theta / deg, calibrated ? 0.0 : error_deg, 0.07) << n << " " << calibrated;
    }
}

TEST(ShaftSensors, WhatCannotBeIsRefused) {
  const auto refused = [](RotorSensing kind, auto&& change) -> std::string {
    Scenario s = sensed(cascade(), kind);
    change(s);
    const base::Problems problems = check(s);
    return problems.empty() ? "nothing" : to_string(problems[0]);
  };
  for (const RotorSensing kind : kinds) {
    EXPECT_EQ(refused(kind, [](Scenario&) {}), "nothing");
    EXPECT_THAT(refused(kind, [](Scenario& s) { s.pwm.commutation = CommutationAt::hall_edge; }),
                HasSubstr("interrupt"));
    Scenario product = product_scenario(Mode::speed, 100);
    product.sensors.rotor = kind;
    product.pwm.commutation = CommutationAt::sample;
    product.sensors.resolver.excitation_Hz = 0.5 / product.pwm.period_s;
    const base::Problems problems = check(product);
    ASSERT_FALSE(problems.empty());
    EXPECT_THAT(to_string(problems[0]), HasSubstr("reads Hall probes"));
  }
  EXPECT_THAT(refused(RotorSensing::absolute, [](Scenario& s) { s.sensors.absolute.latency_s = 30e-6; }),
              HasSubstr("must be below pwm.period_s"));
  EXPECT_THAT(refused(RotorSensing::resolver, [](Scenario& s) { s.sensors.resolver.pole_pairs = 3; }),
              HasSubstr("does not divide"));
  EXPECT_THAT(refused(RotorSensing::resolver, [](Scenario& s) { s.sensors.resolver.excitation_Hz = 10e3; }),
              HasSubstr("miss the excitation's peaks"));
  EXPECT_THAT(refused(RotorSensing::resolver, [](Scenario& s) { s.sensors.resolver.bandwidth_Hz = 2e4; }),
              HasSubstr("half the rate"));
}

}  // namespace SIXSTEP_TEST_FILE

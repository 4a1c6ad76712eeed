// SPDX-License-Identifier: Apache-2.0
// The analogue front end of a scenario within the loop. The tests show the effect of a slow amplifier on a
// controlled current, and the effect of a divider's capacitor on a bus step.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "sixstep/base/angle.hpp"
#include "sixstep/study/run/run.hpp"
#include "tests/support/product_scenarios.hpp"

namespace SIXSTEP_TEST_FILE {

using namespace sixstep;
using namespace sixstep::testing;
using control::Mode;
using rig::CurrentMeasurement;
using study::MetricKind;
using study::Scenario;
using study::Signal;
using ::testing::HasSubstr;

constexpr double T = 30e-6, tau = 0.572e-3 / 1.03, full_A = 24 / 1.03;

double lag_s(double bandwidth_Hz) { return 1 / (2 * base::pi * bandwidth_Hz); }

/// The drive controls 5 A with a locked rotor. The pulses are centred, and the 16-bit converter samples in
/// their middle.
Scenario held_at_5_A(CurrentMeasurement currents, double range_A) {
  Scenario s = maxon_scenario(Mode::current, 5.0);
  s.load.locked = true;
  s.initial.angle_rad = 0.02;
  s.pwm.alignment = study::Alignment::centre;
  s.pwm.sample = study::SampleAt::middle;
  s.sensors.currents = currents;
  s.sensors.adc_bits = 16;
  s.sensors.current_range_A = range_A;
  study::Measure m = measure(MetricKind::mean, Signal::current);
  m.from_s = 10e-3;
  ask(s, m);
  return s;
}

double mean_of(const Scenario& s) {
  const auto out = study::run(s);
  if (!out) ADD_FAILURE() << to_string(out.problems()[0]);
  return out ? out->comparisons[0].measured : -1e9;
}

/// The steady ripple of the locked motor around the mean d U/R, after a first-order lag. The current rises
/// towards U/R in the on-time, and falls towards zero in the off-time, with the time constant L/R.
class Ripple {
 public:
  Ripple(double mean_A, double lag) : lag_(lag), on_s_(mean_A / full_A * T) {
    const double a = std::exp(-on_s_ / tau), b = std::exp(-(T - on_s_) / tau);
    top_ = full_A * (1 - a) / (1 - a * b);
    foot_ = top_ * b;
  }
  /// The current of a phase, after the lag, at the time t after the beginning of its pulse.
  double phase_at(double t) const {
    double x = 0;
    for (int n = 0; n < 2000; ++n) x = behind(behind(x, full_A, foot_, on_s_), 0, top_, T - on_s_);
    return behind(x, full_A, foot_, t);
  }
  /// The current of the DC link after the lag. Outside the pulse, the current of the link is zero.
  double link_at(double t) const {
    double x = 0;
    for (int n = 0; n < 2000; ++n) x = behind(x, full_A, foot_, on_s_) * std::exp(-(T - on_s_) / lag_);
    return behind(x, full_A, foot_, t);
  }
  double on_s() const { return on_s_; }

 private:
  double behind(double x, double final, double start, double t) const {
    const double bent = (start - final) / (1 - lag_ / tau);
    return final + bent * std::exp(-t / tau) + (x - final - bent) * std::exp(-t / lag_);
  }
  double lag_, on_s_, top_ = 0, foot_ = 0;
};

/// The integral controls the mean reading to 5 A, which is a whole number of counts. Each reading is within
/// half a count of the converter's input, so the mean is too. One hundredth is added for the shift that the
/// ripple may cause.
constexpr double held_within = 1.01 * 20.48 / (1 << 16);

TEST(FrontEnd, ASlowAmplifierReadsTheRippleLate) {
  for (const auto& [bandwidth, delay] : {std::pair{160e3, 0.0}, {160e3, 1e-6}, {40e3, 0.5e-6}, {10e3, 0.0}}) {
    Scenario s = held_at_5_A(CurrentMeasurement::phases, 20.48);
    s.sensors.current_bandwidth_Hz = bandwidth;
    s.sensors.current_delay_s = delay;
    const Ripple ripple(mean_of(s), lag_s(bandwidth));
    EXPECT_NEAR(ripple.phase_at(ripple.on_s() / 2 - delay), 5.0, held_within) << bandwidth << " " << delay;
  }
}

/// A current pulse in the DC link starts from zero. In the middle of the pulse, the amplifier still lags, so
/// the reading is too small.
TEST(FrontEnd, TheLinksAmplifierHasToCatchUp) {
  Scenario s = held_at_5_A(CurrentMeasurement::dc_link, 20.48);
  s.sensors.current_bandwidth_Hz = 300e3;
  const double mean = mean_of(s);
  const Ripple ripple(mean, lag_s(300e3));
  EXPECT_NEAR(ripple.link_at(ripple.on_s() / 2), 5.0, held_within);
  EXPECT_GT(mean, 5.01);
}

/// The sample is at the beginning of the pulse, at the minimum of the ripple.
TEST(FrontEnd, TheProductDriveSeesTheSameAmplifier) {
  Scenario s = product_scenario(Mode::current, 3.0);
  s.duration_s = 40e-3;
  s.load.locked = true;
  s.sensors.adc_bits = 16;
  study::Measure m = measure(MetricKind::mean, Signal::current);
  m.from_s = 25e-3;
  ask(s, m);
  s.sensors.current_bandwidth_Hz = 30e3;
  const double count = 2 * 20.48 / (1 << 16);  // A; 3 A is a whole number of counts
  EXPECT_NEAR(Ripple(mean_of(s), lag_s(30e3)).phase_at(0), 3.0, 1.01 * count / 2);
}

/// After a step from 24 V to 40 V, the divider reads 40 - 16 exp(-t/tau). It exceeds 35 V after tau ln(16/5).
/// From then on, the fault counts its samples.
TEST(FrontEnd, ADividersCapacitorHidesAJumpOfTheBus) {
  for (const double bandwidth : {300.0, 1000.0}) {
    Scenario s = product_scenario(Mode::current, 3.0);
    s.duration_s = 30e-3;
    s.load.locked = true;
    s.sensors.bus_range_V = 60;
    s.sensors.adc_bits = 16;
    s.protection.voltage_samples = 3;
    s.sensors.bus_bandwidth_Hz = bandwidth;
    study::At jump;
    jump.time_s = 15e-3;
    jump.supply.voltage_V = 40;
    s.at.push_back(jump);
    const auto out = study::run(s);
    ASSERT_TRUE(out);
    ASSERT_TRUE(out->trip);
    const double passes = 15e-3 + lag_s(bandwidth) * std::log(16.0 / 5);
    EXPECT_GE(out->trip->at_s, passes + 2 * T - 1e-9) << bandwidth;
    EXPECT_LE(out->trip->at_s, passes + 3 * T + 1e-6) << bandwidth;  // 1 us: one count is 0.9 mV, at a slope
                                                                     // of 5 V/tau
  }
}

TEST(FrontEnd, ADelayIsShorterThanAPeriod) {
  Scenario s = held_at_5_A(CurrentMeasurement::phases, 20.48);
  s.sensors.current_delay_s = 30e-6;
  const auto out = study::run(s);
  ASSERT_FALSE(out);
  EXPECT_THAT(to_string(out.problems()[0]), HasSubstr("sensors.current_delay_s = 3e-05"));
  EXPECT_THAT(to_string(out.problems()[0]), HasSubstr("below pwm.period_s"));
}

/// An ideal measurement has no amplifier and no divider.
TEST(FrontEnd, IdealMeasurementIsNotTouched) {
  Scenario plain = held_at_5_A(CurrentMeasurement::ideal, 20.48), slow = plain;
  slow.sensors.current_bandwidth_Hz = 100;
  slow.sensors.current_delay_s = 10e-6;
  slow.sensors.bus_bandwidth_Hz = 100;
  const auto a = study::run(plain), b = study::run(slow);
  ASSERT_TRUE(a && b);
  EXPECT_EQ(a->digest, b->digest);
}

}  // namespace SIXSTEP_TEST_FILE

// SPDX-License-Identifier: Apache-2.0
// The delays that the design states for the speed from an encoder and from a resolver are compared with the
// decoders on an oscillating rotor.
#include "sixstep/design/loops/shaft_sensing.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <functional>

#include "sixstep/base/angle.hpp"
#include "sixstep/base/random.hpp"
#include "sixstep/control/sensing/gray.hpp"
#include "sixstep/control/sensing/pulse_speed.hpp"
#include "sixstep/design/loops/drive_design.hpp"
#include "sixstep/design/loops/tracking_loop.hpp"

namespace sixstep::design {
namespace SIXSTEP_TEST_FILE {

constexpr double T_s = 30e-6;

/// A shaft that turns with the speed w (1 + part sin v t).
struct Swing {
  double w, part, v;
  double angle_rad(double t) const { return w * (t + part / v * (1 - std::cos(v * t))); }
};

/// The delay of a measured speed. It is computed from the phase of the speed's component at v, over whole
/// oscillations after the first few.
double found_delay_s(const Swing& shaft, const std::function<double(double)>& told_at) {
  const int swings = 60, skipped = 10;
  const int per_swing = static_cast<int>(std::floor(2 * base::pi / shaft.v / T_s + 0.5));
  std::complex<double> sum{};
  for (int n = 1; n < swings * per_swing; ++n) {
    const double told = told_at(n * T_s);
    if (n >= skipped * per_swing) sum += (told - shaft.w) * std::polar(1.0, -shaft.v * n * T_s);
  }
  return -(std::arg(sum) + base::pi / 2) / shaft.v;
}

/// A frequency near v, in rad/s, with a whole number of control ticks per oscillation.
double v_near(double v) { return 2 * base::pi / (T_s * std::floor(2 * base::pi / v / T_s)); }

// At a tick, the last edge is half a count old on average.
TEST(EncoderSpeed, IsAsOldAsItIsSaidToBe) {
  for (const double w : {100.0, 5.0}) {  // 1024 lines: a count in 15 us, and in 307 us
    ShaftSensing sensing{.kind = ShaftSensorKind::encoder,
                         .period_s = T_s,
                         .lines = 1024,
                         .capture_Hz = 1e8,
                         .timeout_s = 0.05};
    const double count_rad = 2 * base::pi / 4096;
    control::PulseSpeedConfig<double> config{count_rad * 1e8, 5'000'000};
    control::PulseSpeedState state{};
    const Swing shaft{w, 0.2, v_near(w > 50 ? 3000 : 400)};
    std::int64_t before = 0;
    const double found = found_delay_s(shaft, [&](double t) {
      const auto counts = static_cast<std::int64_t>(std::floor(shaft.angle_rad(t) / count_rad));
      if (counts != before) {
        double low = t - T_s, high = t;  // the time of the last edge
        for (int n = 0; n < 50; ++n) {
          const double middle = (low + high) / 2;
          (shaft.angle_rad(middle) < static_cast<double>(counts) * count_rad ? low : high) = middle;
        }
        control::pulse_edge(state, static_cast<std::int32_t>(counts - before), 1,
                            static_cast<std::uint32_t>(high * 1e8));
        before = counts;
      }
      return control::pulse_speed(config, state, static_cast<std::uint32_t>(t * 1e8));
    });
    const ShaftSpeedAge age = speed_age(sensing, w);
    // A tick uses a count that was completed before the tick. If counts are longer than ticks, half a tick is
    // added for the sampling of the loop itself. An oscillation by a fifth changes the duration of the counts
    // by a fifth.
    EXPECT_NEAR(found, (age.mean_s + age.hold_s) / 2, 0.2 * age.mean_s + T_s / 2) << w;
    EXPECT_GT(age.mean_s, w > 50 ? 0.99 * T_s : 9 * T_s);
  }
}

TEST(AbsoluteSpeed, IsHalfItsWindowAndItsLatencyOld) {
  ShaftSensing sensing{
      .kind = ShaftSensorKind::absolute, .period_s = T_s, .bits = 20, .samples = 8, .latency_s = 20e-6};
  control::GrayConfig<double> config{
      .bits = 20, .span = 8, .speed_per_unit = 2 * base::pi / 0x1p32 / (8 * T_s)};
  control::GrayState state{};
  const Swing shaft{100, 0.2, v_near(1000)};
  const double found = found_delay_s(shaft, [&](double t) {
    const double turns = shaft.angle_rad(t - 20e-6) / (2 * base::pi);
    const auto count = static_cast<std::uint32_t>(std::floor((turns - std::floor(turns)) * 0x1p20));
    return control::gray_step(config, state, control::gray_of_binary(count)).speed;
  });
  const ShaftSpeedAge age = speed_age(sensing, 100);
  // The steps of 2^-20 turn act as noise with a hundredth of the oscillation's amplitude.
  EXPECT_NEAR(found, age.mean_s / 2 + age.late_s, 2e-6);
  EXPECT_NEAR(lowest_told_rad_s(sensing), 2 * base::pi / 0x1p20 / 240e-6, 1e-12);
}

TEST(ResolverSpeed, IsAsLateAndAsNoisyAsItsLoopIsSaidToBe) {
  const auto loop = tracking_loop({.bandwidth_rad_s = 2 * base::pi * 800, .damping = 0.8, .period_s = T_s});
  ASSERT_TRUE(loop);
  ShaftSensing sensing{.kind = ShaftSensorKind::resolver,
                       .period_s = T_s,
                       .pole_pairs = 2,
                       .natural_rad_s = loop->natural_rad_s,
                       .damping = 0.8,
                       .step_s = T_s,
                       .noise_rad = 2e-3};
  const control::TrackingConfig config = tracking_config(*loop);
  const auto binary = [](double turns) {
    return static_cast<control::BinaryAngle>(static_cast<std::int64_t>((turns - std::floor(turns)) * 0x1p32));
  };
  const double told_unit = loop->speed_rad_s_unit / 2;
  control::TrackingState state{};
  const Swing shaft{100, 0.2, v_near(loop->natural_rad_s / 12)};
  const double found = found_delay_s(shaft, [&](double t) {
    control::tracking_follow(config, state, binary(2 * shaft.angle_rad(t) / (2 * base::pi)));
    return control::tracking_speed(state) * told_unit;
  });
  // Sampling adds half a tick. At w_n/12, the phase of the loop's response is equal to the phase of its
  // delay, with a relative error of (1/12)^2.
  EXPECT_NEAR(found, speed_age(sensing, 100).late_s, T_s + 0.01 * speed_age(sensing, 100).late_s);

  control::TrackingState noisy{};
  double squares = 0;
  const int steps = 200000, skipped = 1000;
  for (int n = 0; n < steps; ++n) {
    const double noise = 2e-3 * base::normal({1, 2, static_cast<std::uint64_t>(n)});
    control::tracking_follow(config, noisy, binary(noise / (2 * base::pi)));
    const double told = control::tracking_speed(noisy) * told_unit;
    if (n >= skipped) squares += told * told / (steps - skipped);
  }
  // Sampling changes the time scale of the loop by w_n T_s = 6 %. The variance of the noise is proportional
  // to w_n^3, so its rms changes by 1.5 times 6 %. The rms of the random sample is accurate to 2 %.
  EXPECT_NEAR(std::sqrt(squares) / speed_jitter_rad_s(sensing, 0), 1, 1.5 * loop->natural_rad_s * T_s + 0.02);
}

// The speed loop includes the delay of its sensor, within one degree at the crossover. The design names the
// sensor and its effect.
TEST(DriveDesign, KnowsWhatItsEncoderOrResolverCosts) {
  MotorModel motor;
  motor.machine = {.R_ohm = 0.515, .L_H = 0.286e-3, .K_e_V_s = 0.01675, .pole_pairs = 8};
  motor.shaft = {.J_kg_m2 = 1.35e-5, .B_Nm_s = 7.3e-6};
  motor.K_t_Nm_A = 0.0335;
  motor.nominal_voltage_V = 24.0;
  motor.stall_torque_Nm = 0.78;
  DesignSpec spec{.mode = control::Mode::speed, .settle_s = 30e-3, .torque_limit_Nm = 0.78};
  spec.rotor.shaft = {
      .kind = ShaftSensorKind::absolute, .period_s = T_s, .bits = 14, .samples = 8, .latency_s = 20e-6};
  const auto d = design_drive(motor, spec);
  ASSERT_TRUE(d);
  EXPECT_NEAR(d->lag.delay_s(), 4 * T_s + 20e-6, 1e-12);
  const LoopDesign& speed = d->loop("speed");
  EXPECT_NEAR(*speed.figures.phase_rad - *speed.built.phase_rad,
              *speed.figures.crossover_rad_s * d->lag.delay_s(), 0.02);
  EXPECT_EQ(edges_words(d->spec.rotor), "absolute encoder, 14 bits");
  ASSERT_EQ(d->limits.size(), 3u) << "one sensor, down to three speeds";
  bool told = false;
  for (const DerivationStep& step : d->sensing)
    if (step.symbol == "w_min") told = step.value == lowest_told_rad_s(spec.rotor.shaft);
  EXPECT_TRUE(told);
}

}  // namespace SIXSTEP_TEST_FILE
}  // namespace sixstep::design

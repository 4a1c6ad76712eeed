// SPDX-License-Identifier: Apache-2.0
// Figures of merit are compared with closed forms. The gauge receives Taylor polynomials of known curves.
#include "sixstep/study/measure/gauge.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

namespace SIXSTEP_TEST_FILE {

using namespace sixstep::study;

constexpr double eps = 0x1p-52;
constexpr int degree = 16;

/// The curve re(amplitude e^{lambda t}) + offset over [0, to]. It is passed to the gauge in pieces of unequal
/// length.
struct Curve {
  double offset = 0.0, amplitude = 1.0, rate = -1.0, frequency = 0.0;

  double operator()(double t) const {
    return offset + amplitude * std::exp(rate * t) * std::cos(frequency * t);
  }
  /// The Taylor series at t0 over `length`. The derivatives of e^{(r + i f) t} are computed by complex
  /// powers.
  Series at(double t0, double length) const {
    Series c{};
    double re = amplitude * std::exp(rate * t0) * std::cos(frequency * t0),
           im = amplitude * std::exp(rate * t0) * std::sin(frequency * t0);
    for (int j = 0; j <= degree; ++j) {
      c[j] = re;
      const double f = length / (j + 1), next_re = f * (rate * re - frequency * im);
      im = f * (rate * im + frequency * re);
      re = next_re;
    }
    c[0] += offset;
    return c;
  }
  void feed(Gauge& gauge, double from, double to) const {
    double t = from;
    for (int n = 0; t < to; ++n) {
      const double length = std::min(0.13 + 0.05 * (n % 3), to - t);
      gauge.part(at(t, length), degree, t, length);
      t += length;
    }
  }
};

double gauged(MetricKind kind, const Curve& curve, double to, double level = 0.0,
              std::optional<double> start = {}, std::function<void(Measure&)> change = {}) {
  Measure m;
  m.metric = kind;
  if (change) change(m);
  Gauge gauge(m, {0.0, to}, level, start);
  curve.feed(gauge, 0.0, to);
  return gauge.value().value_or(-1e300);
}

const Curve rise{.offset = 1.0, .amplitude = -1.0, .rate = -1.0};  // 1 - e^{-t}

TEST(Gauge, MeanAndRmsOfAnExponential) {
  constexpr double T = 5.0;
  EXPECT_NEAR(gauged(MetricKind::mean, rise, T), 1 + std::expm1(-T) / T, 64 * eps);
  const double square = T + 2 * std::expm1(-T) - std::expm1(-2 * T) / 2;
  EXPECT_NEAR(gauged(MetricKind::rms, rise, T), std::sqrt(square / T), 64 * eps);
}

TEST(Gauge, ExtremesAndFinalValue) {
  const Curve ring{.amplitude = 2.0, .rate = -0.5, .frequency = 3.0};
  const double t_low = (3.14159265358979323846 - std::atan(0.5 / 3.0)) / 3.0;  // first minimum
  EXPECT_NEAR(gauged(MetricKind::maximum, ring, 4.0), 2.0, 64 * eps);
  EXPECT_NEAR(gauged(MetricKind::minimum, ring, 4.0), ring(t_low), 64 * eps);
  EXPECT_NEAR(gauged(MetricKind::peak_to_peak, ring, 4.0), 2.0 - ring(t_low), 64 * eps);
  EXPECT_NEAR(gauged(MetricKind::final_value, ring, 4.0), ring(4.0), 64 * eps);
}

TEST(Gauge, SettlingAndReachTimeOfAnExponential) {
  // At the crossing, the slope is 0.02. An error of eps in the value therefore shifts the instant by
  // eps/0.02.
  EXPECT_NEAR(gauged(MetricKind::settling_time, rise, 6.0, 1.0, 0.0), std::log(50.0), 64 * eps / 0.02);
  EXPECT_NEAR(gauged(MetricKind::reach_time, rise, 6.0, 1.0, 0.0), std::log(50.0), 64 * eps / 0.02);
  const auto half = [](Measure& m) {
    m.fraction = 0.5;
    m.band = 0.5;
  };
  EXPECT_NEAR(gauged(MetricKind::reach_time, rise, 6.0, 1.0, 0.0, half), std::log(2.0), 64 * eps);
  EXPECT_NEAR(gauged(MetricKind::settling_time, rise, 6.0, 1.0, 0.0, half), std::log(2.0), 64 * eps);
}

TEST(Gauge, RiseTimeOfAnExponentialIsLnNine) {
  // The rise is the time from -ln 0.9 to -ln 0.1. At 90 %, the slope is 0.1.
  EXPECT_NEAR(gauged(MetricKind::rise_time, rise, 6.0, 1.0, 0.0), std::log(9.0), 64 * eps / 0.1);
  const Curve fall{.offset = -1.0, .amplitude = 1.0, .rate = -1.0};  // 0 -> -1
  EXPECT_NEAR(gauged(MetricKind::rise_time, fall, 6.0, -1.0, 0.0), std::log(9.0), 64 * eps / 0.1);
  EXPECT_EQ(gauged(MetricKind::rise_time, rise, 1.0, 1.0, 0.0), std::numeric_limits<double>::infinity())
      << "1 - 1/e is less than 90 %";
}

TEST(Gauge, RippleIsTheRmsAboutTheMeanHoweverLargeThatIs) {
  // The rms of cos over whole periods is 1/sqrt(2). Each coefficient of the curve is rounded by eps/2 of the
  // offset.
  constexpr double offset = 1e6, to = 8 * 3.14159265358979323846;
  const Curve ripple{.offset = offset, .rate = 0.0, .frequency = 1.0};
  const double exact = std::sqrt(0.5), bound = 4 * eps * offset;
  EXPECT_NEAR(gauged(MetricKind::ripple_rms, ripple, to), exact, bound);
  const double rms = gauged(MetricKind::rms, ripple, to), mean = gauged(MetricKind::mean, ripple, to);
  EXPECT_GT(std::fabs(std::sqrt(std::fabs(rms * rms - mean * mean)) - exact), 100 * bound)
      << "a difference of squares would not do";
}

TEST(Gauge, ErrorsAreCountedFromTheLevel) {
  constexpr double T = 5.0;
  EXPECT_NEAR(gauged(MetricKind::steady_error, rise, T, 1.0), -std::expm1(-T) / T, 64 * eps);
  EXPECT_NEAR(gauged(MetricKind::largest_error, rise, T, 0.75), 0.75, 64 * eps) << "at the begin";
  EXPECT_NEAR(gauged(MetricKind::largest_error, rise, T, 0.25), 0.75 - std::exp(-T), 64 * eps)
      << "at the end";
  EXPECT_NEAR(gauged(MetricKind::largest_error, rise, T, -2.0), 3 - std::exp(-T), 64 * eps) << "all above";
}

TEST(Gauge, DownwardsStepsAreJudgedTheSame) {
  const Curve fall{.offset = -1.0, .amplitude = 1.0, .rate = -1.0};  // 0 -> -1
  EXPECT_NEAR(gauged(MetricKind::settling_time, fall, 6.0, -1.0, 0.0), std::log(50.0), 64 * eps / 0.02);
  EXPECT_NEAR(gauged(MetricKind::reach_time, fall, 6.0, -1.0, 0.0), std::log(50.0), 64 * eps / 0.02);
}

TEST(Gauge, OvershootOfARingingStep) {
  const Curve step{.offset = 1.0, .amplitude = -1.0, .rate = -0.5, .frequency = 3.0};
  const double t_top = (3.14159265358979323846 - std::atan(0.5 / 3.0)) / 3.0;
  EXPECT_NEAR(gauged(MetricKind::overshoot, step, 6.0, 1.0, 0.0), step(t_top) - 1.0, 64 * eps);
  EXPECT_EQ(gauged(MetricKind::overshoot, rise, 6.0, 1.0, 0.0), 0.0);
}

TEST(Gauge, SettlingCountsTheLastExcursion) {
  // The curve is e^{-t/2} cos 3t. A scan finds the last crossing into the 10 % band.
  const Curve step{.offset = 1.0, .amplitude = -1.0, .rate = -0.5, .frequency = 3.0};
  double last = 0;
  for (int n = 0; n < 1200000; ++n)
    if (std::fabs(step(n * 1e-5) - 1.0) > 0.1) last = n * 1e-5;
  const auto band = [](Measure& m) { m.band = 0.1; };
  EXPECT_NEAR(gauged(MetricKind::settling_time, step, 12.0, 1.0, 0.0, band), last, 1e-5);
}

TEST(Gauge, NeverReachedAndNeverSettledAreInfinite) {
  EXPECT_EQ(gauged(MetricKind::reach_time, rise, 1.0, 1.0, 0.0), std::numeric_limits<double>::infinity());
  EXPECT_EQ(gauged(MetricKind::settling_time, rise, 1.0, 1.0, 0.0), std::numeric_limits<double>::infinity());
}

TEST(Gauge, AWindowThatSawNothingHasNoValue) { EXPECT_FALSE(Gauge(Measure{}, {0.0, 1.0}, 0.0, {}).value()); }

TEST(Gauge, WithoutAStartTheFirstValueCounts) {
  const Curve from_half{.offset = 1.0, .amplitude = -0.5, .rate = -1.0};  // height 0.5
  EXPECT_NEAR(gauged(MetricKind::settling_time, from_half, 6.0, 1.0), std::log(50.0), 64 * eps / 0.01);
}

TEST(Gauge, SamplesAreAllThatASampledMeasureSees) {
  Measure m;
  m.sampled = true;
  m.metric = MetricKind::settling_time;
  Gauge gauge(m, {0.0, 10.0}, 1.0, 0.0);
  rise.feed(gauge, 0.0, 10.0);
  EXPECT_FALSE(gauge.value()) << "curves are ignored";
  for (int n = 0; n < 100; ++n) gauge.sample(0.1 * n, rise(0.1 * n));
  EXPECT_EQ(*gauge.value(), 0.1 * 40) << "the first sample after ln 50 = 3.912";
  m.metric = MetricKind::rise_time;
  Gauge steps(m, {0.0, 10.0}, 1.0, 0.0);
  for (int n = 0; n < 100; ++n) steps.sample(0.25 * n, rise(0.25 * n));
  EXPECT_EQ(*steps.value(), 2.5 - 0.25) << "the first samples after 0.105 and 2.303";
  m.metric = MetricKind::ripple_rms;
  Gauge ripple(m, {0.0, 10.0}, 0.0, {});
  for (int n = 0; n < 100; ++n) ripple.sample(0.1 * n, 1e6 + (n % 2 == 0 ? 1 : -1));
  EXPECT_NEAR(*ripple.value(), 1.0, 4 * eps * 1e6) << "as many above as below";
  m.metric = MetricKind::mean;
  Gauge mean(m, {0.0, 0.35}, 0.0, {});
  for (int n = 0; n < 100; ++n) mean.sample(0.1 * n, n);
  EXPECT_EQ(*mean.value(), 1.5) << "0, 1, 2, 3: half-open windows";
}

}  // namespace SIXSTEP_TEST_FILE

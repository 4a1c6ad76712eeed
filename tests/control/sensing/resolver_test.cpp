// SPDX-License-Identifier: Apache-2.0
#include "sixstep/control/sensing/resolver.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <type_traits>

#include "tests/control/scalars.hpp"
#include "tests/control/sensing/drawn.hpp"
#include "tests/control/sensing/second_order.hpp"

namespace SIXSTEP_TEST_FILE {

using namespace sixstep::control;

static_assert(std::is_trivially_copyable_v<ResolverState>);

constexpr double pi = std::numbers::pi, turn = 4294967296.0;
constexpr double amplitude = 0.6;  // relative to the chip's signals

/// Windings and converter by their definition (model.md 10): amplitude k V_R, offsets and noise in counts,
/// amplitude imbalance a, and skew q in rad.
struct Windings {
  double counts = 1800, a = 0, q = 0, cos_offset = 2048, sin_offset = 2048, noise = 0;
  int most = 4095;

  ResolverCounts at(double phi, bool positive, Drawn& drawn) const {
    const double carrier = positive ? 1 : -1;
    const auto read = [&](double volts) {
      const double n = std::floor(volts + (noise > 0 ? noise * drawn.normal() : 0) + 0.5);
      return static_cast<std::uint16_t>(std::clamp(n, 0.0, static_cast<double>(most)));
    };
    return {read(counts * carrier * std::cos(phi) + cos_offset),
            read(counts * (1 + a) * carrier * std::sin(phi + q) + sin_offset)};
  }
};

template <class S>
ResolverConfig<S> config(const Windings& w, const SecondOrder& loop) {
  return {.cos_per_count = per_count<S>(amplitude / w.counts / 2),
          .sin_per_count = per_count<S>(amplitude / w.counts / 2 / ((1 + w.a) * std::cos(w.q))),
          .skew = static_cast<Gain<S>>(std::tan(w.q)),
          .loop = loop.config(),
          .least_square = static_cast<S>(0.25 * amplitude * amplitude),
          .greatest_square = static_cast<S>(0.8),
          .lost_after = 3};
}

/// Error of the angle, in rad, after `samples` samples of a rotor at rest at `phi`.
template <class S>
double error_at(double phi, const Windings& w, const ResolverConfig<S>& c, Drawn& drawn, int samples = 400) {
  ResolverState state;
  ResolverReading<S> r;
  for (int n = 0; n < samples; ++n) {
    const bool positive = n % 2 == 0;
    r = resolver_step(c, state, w.at(phi, positive, drawn), positive);
  }
  return std::remainder(r.angle / turn * 2 * pi - phi, 2 * pi);
}

/// Bound of the angle's error at rest, in rad. The halved difference of each winding has a rounding error of
/// half a count. Each signal, and the two products of the detector with the sine table, have a rounding error
/// of four digits of the format.
template <class S>
double static_bound(const Windings& w) {
  const double digits = is_fixed<S> ? 8 * digit<S>() / amplitude : 8 * digit<S>();
  return std::sqrt(0.5) / w.counts * (1 + std::fabs(std::tan(w.q))) + 3.2e-7 + digits;
}

template <class Scalar>
class Resolver : public ::testing::Test {};
TYPED_TEST_SUITE(Resolver, SensingScalars);

/// Known imbalance, skew and offsets are corrected over the whole turn. If they are not known to the decoder,
/// they cause errors of the angle.
TYPED_TEST(Resolver, TheAngleIsRightAllAroundAndOnlyCorrected) {
  using S = TypeParam;
  const SecondOrder loop(0.15, 0.8);
  Windings w{.a = 0.04, .q = 0.03, .cos_offset = 2100, .sin_offset = 1990};
  const ResolverConfig<S> c = config<S>(w, loop);
  ResolverConfig<S> plain = c;
  plain.sin_per_count = c.cos_per_count;
  plain.skew = {};
  Drawn drawn{1};
  double worst = 0, worst_plain = 0;
  for (double phi = -pi; phi < pi; phi += 0.0131) {
    worst = std::max(worst, std::fabs(error_at(phi, w, c, drawn)));
    worst_plain = std::max(worst_plain, std::fabs(error_at(phi, w, plain, drawn)));
  }
  std::printf("largest error %.3g rad, bound %.3g\n", worst, static_bound<S>(w));
  EXPECT_LE(worst, static_bound<S>(w));
  // The error is the largest value of a/2 sin 2 phi + q (1 + cos 2 phi)/2, with imbalance a and skew q. This
  // value is q/2 + sqrt((a/2)^2 + (q/2)^2). Terms of second order change it by less than a tenth.
  const double law = w.q / 2 + std::hypot(w.a / 2, w.q / 2);
  EXPECT_NEAR(worst_plain, law, 0.1 * law);
}

/// resolver_signals subtracts the constant offset that remains in each signal after demodulation.
TYPED_TEST(Resolver, ConstantOffsetsOfTheSignalsAreTakenAway) {
  using S = TypeParam;
  const SecondOrder loop(0.15, 0.8);
  const Windings w;
  ResolverConfig<S> c = config<S>(w, loop);
  c.cos_offset = static_cast<S>(0.05);
  c.sin_offset = static_cast<S>(-0.02);
  const auto counts = [&](double cos, double sin) {
    const auto n = [&](double x) {
      return static_cast<std::uint16_t>(std::lround(2048 + x * w.counts / amplitude));
    };
    return ResolverCounts{n(cos), n(sin)};
  };
  const auto x = resolver_signals(c, counts(-0.35, -0.38), counts(0.35, 0.38), true);
  const double half_count = amplitude / w.counts / 2;
  const double own = 3 * digit<S>() + (sizeof(S) == 2 ? std::ldexp(1.0, -14) : 0.0);
  EXPECT_NEAR(static_cast<double>(x.c), 0.30, half_count + own);
  EXPECT_NEAR(static_cast<double>(x.s), 0.40, half_count + own);
}

/// The loop locks to the rotor from any initial error, including exactly half a turn.
TYPED_TEST(Resolver, LocksFromAnywhere) {
  using S = TypeParam;
  const SecondOrder loop(0.1, 0.8);
  Drawn drawn{2};
  for (const bool normalise : {true, false})
    for (int k = 0; k < 64; ++k) {
      const Windings w;
      ResolverConfig<S> c = config<S>(w, loop);
      c.normalise = normalise;
      const double phi = 2 * pi * k / 64;
      // Without normalisation, the natural frequency of the loop decreases with the amplitude.
      EXPECT_LE(std::fabs(error_at(phi, w, c, drawn, 1000)), static_bound<S>(w)) << k << ' ' << normalise;
    }
}

/// For a turning rotor, the result is the angle in the middle between two samples, which is a quarter of an
/// excitation period before the later sample.
TYPED_TEST(Resolver, AtSpeedTheAngleIsThatOfTheMiddle) {
  using S = TypeParam;
  const SecondOrder loop(0.15, 0.8);
  const Windings w;
  const ResolverConfig<S> c = config<S>(w, loop);
  Drawn drawn{3};
  for (const double per_sample : {-0.2, -0.01, 0.003, 0.1}) {  // rad per half period of the excitation
    ResolverState state;
    for (int n = 0; n < 800; ++n) {
      const double phi = per_sample * n;
      const auto r = resolver_step(c, state, w.at(phi, n % 2 == 0, drawn), n % 2 == 0);
      if (n < 300) continue;
      const double off = std::remainder(r.angle / turn * 2 * pi - (phi - per_sample / 2), 2 * pi);
      // The loop predicts from earlier results. Their rounding errors are weighted by the loop's step
      // response, and at most double the error.
      const double tail = 1 + loop.K_p() + loop.K_i();
      ASSERT_LE(std::fabs(off), 2 * tail * static_bound<S>(w)) << per_sample;
      ASSERT_NEAR(r.speed / turn * 2 * pi, per_sample, 4 * (loop.K_p() + loop.K_i()) * static_bound<S>(w));
    }
  }
}

/// Small steps decay as in the linear loop, because the tangent in the detector exceeds the error e by at
/// most e^3/3.
TYPED_TEST(Resolver, FollowsAsTheLinearLoop) {
  using S = TypeParam;
  const SecondOrder loop(0.1, 0.6);
  Windings w{.counts = 28000, .cos_offset = 32768, .sin_offset = 32768, .most = 65535};
  const double step = 0.06;
  Drawn drawn{4};
  for (const double part : {1.0, 0.7}) {  // with normalisation the amplitude has no effect
    const ResolverConfig<S> c = config<S>(w, loop);
    Windings weaker = w;
    weaker.counts *= part;
    ResolverState state;
    state.loop.angle = of_turns((1 + step) / (2 * pi));
    resolver_hold(state, weaker.at(1, false, drawn));
    for (int n = 0; n < 150; ++n) {
      const bool positive = n % 2 == 0;
      const auto r = resolver_step(c, state, weaker.at(1, positive, drawn), positive);
      const double off = r.angle / turn * 2 * pi - 1;
      double answers = 0;  // the detector's error in each tick, weighted by the loop's response
      for (int k = 1; k <= n; ++k) answers += std::fabs(loop.error(k) - loop.error(k - 1));
      const double detector = static_bound<S>(weaker) / part + step * step * step / 3;
      ASSERT_NEAR(off, step * loop.error(n), answers * detector + 1e-9) << n << " at " << part;
    }
  }
}

/// At the constant acceleration alpha, the angle lags by alpha/K_a, with the acceleration constant K_a of the
/// loop.
TEST(ResolverLaw, ConstantAccelerationLeavesAlphaByKa) {
  const SecondOrder loop(0.05, 0.7);
  Windings w{.counts = 28000, .cos_offset = 32768, .sin_offset = 32768, .most = 65535};
  const ResolverConfig<double> c = config<double>(w, loop);
  Drawn drawn{5};
  const double alpha = 4e-5;  // rad per sample^2: an error of 0.016 rad
  ResolverState state;
  double mean = 0;
  const int from = 500, to = 1500;
  for (int n = 0; n < to; ++n) {
    const double at = n - 0.5;  // the middle; the angle of the chord is equal to the angle in its middle, to
                                // alpha/8
    const auto r = resolver_step(c, state, w.at(alpha * n * n / 2, n % 2 == 0, drawn), n % 2 == 0);
    if (n >= from)
      mean += std::remainder(alpha * at * at / 2 - r.angle / turn * 2 * pi, 2 * pi) / (to - from);
  }
  const double e = alpha / loop.K_i();
  EXPECT_NEAR(mean, e, static_bound<double>(w) + e * e * e + alpha / 8);
}

TEST(ResolverLaw, TheAmplitudeTakenForOneMakesTheLoopSlower) {
  const SecondOrder loop(0.05, 0.7);
  const Windings w;
  ResolverConfig<double> c = config<double>(w, loop);
  Drawn drawn{6};
  double first[2]{};
  for (const bool normalise : {true, false}) {
    c.normalise = normalise;
    ResolverState state;
    resolver_hold(state, w.at(0.02, false, drawn));
    resolver_step(c, state, w.at(0.02, true, drawn), true);
    first[normalise] = state.loop.error;
  }
  // The tolerance is half a count in each of the two amplitudes.
  EXPECT_NEAR(first[0] / first[1], amplitude, 2 * std::sqrt(0.5) / w.counts / 0.02);
}

/// A broken excitation, a winding that breaks at its peak, and a short circuit raise the alarm after three
/// results. Noise does not raise the alarm.
TYPED_TEST(Resolver, LossOfSignalIsTold) {
  using S = TypeParam;
  const SecondOrder loop(0.1, 0.8);
  Windings w{.noise = 2};
  const ResolverConfig<S> c = config<S>(w, loop);
  Drawn drawn{7};
  ResolverState state;
  for (int n = 0; n < 5000; ++n)
    ASSERT_FALSE(resolver_step(c, state, w.at(0.01 * n, n % 2 == 0, drawn), n % 2 == 0).lost);
  const auto lost_after = [&](ResolverCounts high, ResolverCounts low) {
    ResolverState copy = state;
    for (int n = 1; n <= 10; ++n)
      if (resolver_step(c, copy, n % 2 == 0 ? high : low, n % 2 == 0).lost) return n;
    return 0;
  };
  EXPECT_EQ(lost_after({2048, 2048}, {2048, 2048}), 4)
      << "no excitation: the first result still has half of it";
  EXPECT_EQ(lost_after({2048, 2248}, {2048, 1848}), 4) << "a winding broken, the other near its zero";
  EXPECT_EQ(lost_after({4095, 4095}, {0, 0}), 4) << "both at their ends";
}

/// In a sequence of two results outside the limits and one result inside, three results in a row are never
/// outside.
TEST(ResolverLaw, SingleDisturbancesAreNoLoss) {
  const SecondOrder loop(0.1, 0.8);
  const Windings w;
  ResolverConfig<double> c = config<double>(w, loop);
  c.least_square = 0.5 * amplitude * amplitude;  // half a sample is a quarter of the square
  Drawn drawn{8};
  ResolverState state;
  int outside = 0;
  for (int n = 0; n < 300; ++n) {
    // A missing sample makes two results wrong: the difference with the sample before it, and the difference
    // with the sample after it.
    const bool missing = n % 3 == 2;
    const auto r = resolver_step(
        c, state, missing ? ResolverCounts{2048, 2048} : w.at(0.5, n % 2 == 0, drawn), n % 2 == 0);
    outside += n > 0 && r.square < c.least_square;
    ASSERT_FALSE(r.lost) << n;
  }
  EXPECT_GT(outside, 150);
}

/// Without signals, the angle does not change.
TEST(ResolverLaw, ADeadResolverDoesNotTurn) {
  const SecondOrder loop(0.1, 0.8);
  const ResolverConfig<Q15> c = config<Q15>(Windings{}, loop);
  ResolverState state;
  state.loop.angle = 12345;
  for (int n = 0; n < 100; ++n)
    EXPECT_EQ(resolver_step(c, state, {2048, 2048}, n % 2 == 0).angle, n == 0 ? 0u : 12345u);
}

}  // namespace SIXSTEP_TEST_FILE

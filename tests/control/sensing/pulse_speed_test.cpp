// SPDX-License-Identifier: Apache-2.0
#include "sixstep/control/sensing/pulse_speed.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <functional>
#include <numbers>
#include <type_traits>

#include "tests/control/scalars.hpp"
#include "tests/control/sensing/drawn.hpp"

namespace SIXSTEP_TEST_FILE {

using namespace sixstep::control;

static_assert(std::is_trivially_copyable_v<PulseSpeedState>);

constexpr double timer_Hz = 1e6;
constexpr double counts_per_rad = 4096 / (2 * std::numbers::pi);

template <class S>
PulseSpeedConfig<S> config(double base = 1.0) {
  return {static_cast<TickRatio<S>>(timer_Hz / counts_per_rad / base), 200000};
}

/// An encoder whose position, in counts, is a monotonic function of time between two control ticks. Each edge
/// is captured with its own timer count.
class Encoder {
 public:
  explicit Encoder(std::function<double(double)> place) : place_(std::move(place)) {
    at_ = std::floor(place_(0));
  }

  /// Advances to the time t. Bisection finds the edges to 1e-10 s.
  void run(PulseSpeedState& state, double t) {
    const double end = std::floor(place_(t));
    for (; at_ < end; ++at_) pulse_edge(state, 1, 1, ticks(passing(at_ + 1, t)));
    for (; at_ > end; --at_) pulse_edge(state, -1, -1, ticks(passing(at_, t)));
    time_ = t;
  }
  static std::uint32_t ticks(double t) {
    return static_cast<std::uint32_t>(static_cast<std::uint64_t>(t * timer_Hz) + 0xfffff000u);  // wraps soon
  }

  double last_edge() const { return edge_; }

 private:
  double passing(double border, double until) {
    double low = time_, high = until;
    const bool rising = place_(high) > place_(low);
    while (high - low > 1e-10) {
      const double middle = (low + high) / 2;
      ((place_(middle) >= border) == rising ? high : low) = middle;
    }
    return edge_ = high;
  }
  std::function<double(double)> place_;
  double at_ = 0, time_ = 0, edge_ = 0;
};

template <class Scalar>
class PulseSpeed : public ::testing::Test {};
TYPED_TEST_SUITE(PulseSpeed, SensingScalars);

/// From 1 to 10000 rad/s, in both directions, the speed is accurate to one timer tick in the measuring time
/// T. T is at least the time of a count, and at least the period minus the time of a count.
TYPED_TEST(PulseSpeed, IsRightToATickOfTheTimer) {
  using S = TypeParam;
  const double base = is_fixed<S> ? 10400.0 : 1.0, period = 1e-3;
  double worst_part = 0;
  for (double w = 1; w <= 10000; w *= 1.6)
    for (const double sign : {1.0, -1.0}) {
      Encoder encoder([=](double t) { return sign * w * counts_per_rad * t + 0.3; });
      PulseSpeedState state;
      const auto c = config<S>(base);
      const double count_s = 1 / (w * counts_per_rad);
      for (int n = 1; n < 30; ++n) {
        const double t = n * period;
        encoder.run(state, t);
        const double found = static_cast<double>(pulse_speed(c, state, Encoder::ticks(t))) * base;
        if (t < 2 * (period + count_s)) continue;  // two ticks with an edge
        const double T_ticks = timer_Hz * std::max(count_s, period - count_s);
        // Times are truncated to ticks. T is wrong by up to one tick, and so is the time `since`, which
        // bounds the speed. The format rounds the ratio by half a digit; for M = 1 edge, this is relative to
        // the product.
        const double ratio = is_fixed<S> ? 0.5 * digit<S>() * base / (timer_Hz / counts_per_rad) : digit<S>();
        const double bound = w * (1 / (T_ticks - 1) + ratio) + digit<S>() * (is_fixed<S> ? base : w);
        ASSERT_NEAR(found, sign * w, bound) << w << " at " << n;
        worst_part = std::max(worst_part, std::fabs(found - sign * w) / bound);
      }
    }
  std::printf("largest error %.2f of the bound\n", worst_part);
  EXPECT_GT(worst_part, 0.5) << "the bound is no wider than it must be";
}

/// If the rotor stops, the estimated speed decreases at least as fast as the missing edge implies. Then it
/// becomes 0.
TEST(PulseSpeedLaw, AStandstillIsBoundedAndTimesOut) {
  const auto c = config<double>();
  Encoder encoder([](double t) { return 400.0 * counts_per_rad * std::min(t, 0.05); });
  PulseSpeedState state;
  double last = 1e9;
  for (int n = 1; n < 400; ++n) {
    const double t = n * 1e-3;
    encoder.run(state, t);
    const double w = pulse_speed(c, state, Encoder::ticks(t));
    if (t < 0.0505) continue;
    const double since = t - 0.05;  // the last edge is at most one count older
    EXPECT_LE(w, 1 / (counts_per_rad * (since - 2e-6)));
    EXPECT_LE(w, last);
    if (since > 0.2) {
      EXPECT_EQ(w, 0);
    }
    if (since < 0.2 - 2 / (400 * counts_per_rad)) {
      EXPECT_GT(w, 0);
    }
    last = w;
  }
}

/// The edges are at 1000 and 1500 ticks, truncated to ticks. 2000 ticks after the last edge, the true
/// interval may be only 1999 ticks.
TEST(PulseSpeedLaw, TheBoundGrantsATick) {
  const PulseSpeedConfig<double> c{1e6, 100000};
  PulseSpeedState state;
  pulse_edge(state, 1, 1, 1000);
  EXPECT_EQ(pulse_speed(c, state, 1010), 0.0) << "one edge alone says nothing";
  pulse_edge(state, 1, 1, 1500);
  EXPECT_EQ(pulse_speed(c, state, 1510), 1e6 / 500);
  EXPECT_EQ(pulse_speed(c, state, 2001), 1e6 / 500) << "still due";
  EXPECT_EQ(pulse_speed(c, state, 3500), 1e6 / 1999);
  pulse_edge(state, -3, -1, 4500);  // the rotor passes the last edge backwards, and then two more edges
  EXPECT_EQ(pulse_speed(c, state, 4510), -2e6 / 3000);
}

/// During a reversal, the speed is the movement of the rotor divided by the time between the last edges of
/// two ticks. The limit from a missing edge also applies. An edge that is passed forward and backward adds no
/// movement.
TEST(PulseSpeedLaw, AReversalIsTheMeanOverItsTime) {
  const auto c = config<double>();
  const auto place = [](double t) { return 1000.5 - 4e5 * (t - 0.1003) * (t - 0.1003); };
  Encoder encoder(place);
  PulseSpeedState state;
  double from = 0, to = 0;
  int reversals = 0, bounded = 0;
  double before = 0;
  for (int n = 1; n < 200; ++n) {
    const double t = n * 1e-3;
    encoder.run(state, t);
    const double w = pulse_speed(c, state, Encoder::ticks(t));
    if (encoder.last_edge() != to) {
      from = to;
      to = encoder.last_edge();
    }
    if (n < 3) continue;
    const double T_ticks = (to - from) * timer_Hz, since_ticks = (t - to) * timer_Hz;
    const double mean = (place(to) - place(from)) / counts_per_rad / (to - from);
    const double allowed = timer_Hz / counts_per_rad / (since_ticks + 1);
    // T is accurate to a timer tick, positions are accurate to 1e-10 s.
    EXPECT_LE(std::fabs(w), std::fabs(mean) * (1 + 1 / (T_ticks - 1)) + 1e-4) << t;
    EXPECT_GE(std::fabs(w), std::fmin(std::fabs(mean) * (1 - 1 / T_ticks), allowed) - 1e-4) << t;
    EXPECT_GE(w * mean, 0) << t;
    bounded += allowed < std::fabs(mean);
    reversals += before > 0 && w < 0;
    if (w != 0) before = w;
  }
  EXPECT_EQ(reversals, 1);
  EXPECT_GT(bounded, 0);
}

/// Oscillation around one edge gives a speed of 0, for any number of passes over this edge.
TEST(PulseSpeedLaw, DitherAboutAnEdgeIsStandstill) {
  const auto c = config<double>();
  PulseSpeedState state;
  std::uint32_t now = 0;
  Drawn drawn{7};
  std::int8_t next = 1;
  for (int n = 0; n < 10000; ++n) {
    now += 1 + drawn.below(500);
    pulse_edge(state, next, next, now);
    next = static_cast<std::int8_t>(-next);
    if (drawn.unit() < 0.3) {
      ASSERT_EQ(pulse_speed(c, state, now + 1), 0.0) << "seed " << drawn.seed;
    }
  }
}

/// Every 37th edge is missing. Edges are 1000 timer ticks apart, and a control tick contains M edges. The
/// control tick shifts by one timer tick relative to the edges, so that every phase occurs equally often.
/// According to the header, the mean speed is lowered by 2 - ln 2 - 1/(M (M + 1)) times the missing fraction.
TEST(PulseSpeedLaw, MissedEdgesLowerTheMeanByTheirShareAndByTheBound) {
  for (const int M : {1, 2, 3, 5, 9}) {
    const PulseSpeedConfig<double> c{1000.0, 1000000};  // one edge per 1000 ticks is a speed of 1
    PulseSpeedState state;
    std::uint32_t now = 500, edge = 0, number = 0;
    double sum = 0.0, counted = 0.0, ticks = 0.0;
    constexpr int readings = 370000;
    for (int n = 0; n < readings; ++n) {
      now += static_cast<std::uint32_t>(1000 * M + 1);
      while (now - edge >= 1000) {
        edge += 1000;
        if (++number % 37 != 0) pulse_edge(state, 1, 1, edge);
      }
      const std::uint32_t to = state.fresh ? state.time : 0, from = state.from_time;
      const double w = pulse_speed(c, state, now);
      if (n < 2) continue;
      sum += 1 - w;
      if (to == 0) continue;
      counted += state.moved;
      ticks += to - from;
    }
    const double share = 1.0 / 37, law = 2 - std::log(2.0) - 1.0 / (M * (M + 1));
    // The tolerance has two parts: a tick of 1000 in the bound, and a thousandth of the control ticks, in
    // which M + 1 edges occur.
    EXPECT_NEAR(sum / (readings - 2) / share, law, 0.004) << M;
    EXPECT_NEAR(1000 * counted / ticks, 1 - share, 1.0 / (readings * M))
        << "over its own windows, but for a miss at their ends";
  }
}

}  // namespace SIXSTEP_TEST_FILE

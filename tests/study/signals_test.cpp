// SPDX-License-Identifier: Apache-2.0
// The cheap bounds of a signal: what lets most segments go without a search for extremes.
#include "sixstep/study/signals.hpp"

#include <gtest/gtest.h>

#include "sixstep/study/gauge.hpp"
#include "tests/support/board.hpp"

namespace {

using namespace sixstep;
using namespace sixstep::testing;
using namespace sixstep::study;

constexpr Signal bounded[] = {Signal::current, Signal::phase_a,     Signal::phase_b,
                              Signal::phase_c, Signal::bus_current, Signal::speed};

struct WithinBounds {
  std::int64_t segments = 0, breaches = 0, useful = 0;

  template <class Rig>
  void segment(const Rig& rig, double) {
    const int degree = rig.plant().expansion().degree;
    for (const Signal signal : bounded) {
      const Series c = signal_series(rig, signal, {});
      const series::Extremes<double> e = series::extremes(c, degree), b = signal_bounds(rig, signal);
      ++segments;
      breaches += !(b.low <= e.low && e.high <= b.high);
      // A straight line is bounded by itself and, on the other side, by its mirror image: twice as wide.
      useful += b.high - b.low <= 2.5 * (e.high - e.low) + 1e-9;
    }
  }
};

TEST(SignalBounds, HoldTheWholeCurve) {
  for (const bool sine : {false, true}) {
    for (const double duty : {0.3, -0.95}) {
      Board b = Board::duty(duty);
      if (sine) b.machine.back_emf = plant::BackEmf::sine;
      b.devices = {.R_on_ohm = 0.02, .V_f_V = 0.7, .r_d_ohm = 0.01};
      auto rig = b.rig();
      WithinBounds within;
      ASSERT_EQ(run_to(rig, 10e-3, within), sim::Stop::end);
      EXPECT_EQ(within.breaches, 0) << sine << " " << duty;
      EXPECT_GT(within.segments, 3000);
      EXPECT_GT(within.useful, within.segments / 2) << "bounds as wide as this exclude nothing";
    }
  }
}

TEST(SignalBounds, NoneForWhatHasNoneAtHand) {
  auto rig = Board::duty(0.3).rig();
  EXPECT_EQ(signal_bounds(rig, Signal::current_magnitude).high, std::numeric_limits<double>::infinity());
  EXPECT_EQ(signal_bounds(rig, Signal::torque).low, -std::numeric_limits<double>::infinity());
}

Gauge seen(MetricKind kind, double level = 0.0) {
  Measure m;
  m.metric = kind;
  Gauge gauge(m, {0.0, 10.0}, level, 0.0);
  gauge.part({1.0, 2.0}, 1, 0.0, 1.0);  // from 1 to 3
  return gauge;
}

TEST(GaugeHolds, OnlyOnTheSideThatCounts) {
  const series::Extremes<double> above{2.0, 4.0}, below{0.0, 2.0}, inside{1.0, 3.0};
  EXPECT_TRUE(seen(MetricKind::maximum).holds(below));
  EXPECT_FALSE(seen(MetricKind::maximum).holds(above));
  EXPECT_TRUE(seen(MetricKind::minimum).holds(above));
  EXPECT_FALSE(seen(MetricKind::minimum).holds(below));
  EXPECT_TRUE(seen(MetricKind::peak_to_peak).holds(inside));
  EXPECT_FALSE(seen(MetricKind::peak_to_peak).holds(above));
  EXPECT_FALSE(seen(MetricKind::peak_to_peak).holds(below));
  EXPECT_TRUE(seen(MetricKind::overshoot, 5.0).holds(below));
  EXPECT_FALSE(seen(MetricKind::overshoot, 5.0).holds(above));
  EXPECT_TRUE(seen(MetricKind::overshoot, -5.0).holds(above));
  EXPECT_FALSE(seen(MetricKind::overshoot, -5.0).holds(below));
}

TEST(GaugeHolds, NeverBeforeTheFirstPartNorForOtherMetrics) {
  Measure m;
  m.metric = MetricKind::maximum;
  EXPECT_FALSE(Gauge(m, {0.0, 1.0}, 0.0, {}).holds({0.0, 0.0}));
  EXPECT_FALSE(seen(MetricKind::mean).holds({2.0, 2.0}));
  EXPECT_FALSE(seen(MetricKind::final_value).holds({2.0, 2.0}));
}

}  // namespace

// SPDX-License-Identifier: Apache-2.0
// If the comparator is on the board, the excess and the shortfall of the band are zero. If it is in the
// controller, they are at most the change of the current per sample.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/scenarios.hpp"

namespace SIXSTEP_TEST_FILE {

using namespace sixstep;
using namespace sixstep::testing;
using namespace sixstep::study;

Outcome judged(Comparator comparator, HysteresisOn on = HysteresisOn::motor,
               control::Chopping chopping = control::Chopping::soft) {
  Scenario s = current_square();
  s.pwm.chopping = chopping;
  s.control.current = {
      .type = CurrentLoopType::hysteresis, .band_A = 0.2, .on = on, .comparator = comparator};
  ask(s, measure(MetricKind::band_excess, Signal::current));
  ask(s, measure(MetricKind::band_deficit, Signal::current));
  const auto out = run(s);
  EXPECT_TRUE(out);
  return *out;
}

TEST(HysteresisFigures, EventComparatorsKeepTheBand) {
  for (const auto on : {HysteresisOn::motor, HysteresisOn::phase}) {
    const Outcome out = judged(Comparator::event, on);
    EXPECT_NEAR(out.comparisons[0].measured, 0.0, 128 * 0x1p-52 * 23.3) << "excess";
  }
}

TEST(HysteresisFigures, SampledComparatorsHoldNoBand) {
  // At standstill, the current rises by 24 V * 30 us/0.572 mH = 1.26 A per sample. Figures of the band would
  // therefore be misleading.
  Scenario s = current_square();
  s.control.current = {.type = CurrentLoopType::hysteresis, .band_A = 0.2, .comparator = Comparator::sampled};
  ask(s, measure(MetricKind::band_excess, Signal::current));
  const auto out = run(s);
  ASSERT_FALSE(out);
  EXPECT_EQ(out.problems().front().where, "compare[0].metric");
}

/// The rotor is locked, and the current is between 4.8 and 5.2 A. L di/dt is U - R i when the current rises.
/// It is -R i when the current falls, or -U - R i with hard chopping. One comparator switches at the same
/// frequency as two comparators.
TEST(HysteresisFigures, TheFrequencyIsThatOfTheWindingInTheBand) {
  constexpr double U = 24, R = 1.03, L = 0.572e-3, low = 4.8, high = 5.2, from_s = 5e-3, to_s = 25e-3;
  for (const auto chopping : {control::Chopping::soft, control::Chopping::hard})
    for (const auto on : {HysteresisOn::motor, HysteresisOn::phase}) {
      Scenario s = current_square();
      s.reference = {.value = 5.0};
      s.duration_s = to_s;
      s.load.inertia_kg_m2 = 10.0;
      s.initial.angle_rad = 0.5 / 8;
      s.pwm.chopping = chopping;
      s.control.current = {
          .type = CurrentLoopType::hysteresis, .band_A = 0.2, .on = on, .comparator = Comparator::event};
      Measure frequency = measure(MetricKind::switching_frequency, Signal::current);
      frequency.from_s = from_s;
      frequency.to_s = to_s;
      ask(s, frequency);
      const auto out = run(s);
      ASSERT_TRUE(out) << to_string(out.problems()[0]);
      const double down = chopping == control::Chopping::hard ? -U / R : 0.0;
      const double cycle_s = L / R * std::log((U / R - low) / (U / R - high) * (high - down) / (low - down));
      EXPECT_NEAR(out->comparisons.back().measured, 1 / cycle_s, 1 / (to_s - from_s))
          << "one turn-on more or less in the window";
    }
}

}  // namespace SIXSTEP_TEST_FILE

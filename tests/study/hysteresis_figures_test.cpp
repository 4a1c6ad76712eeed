// SPDX-License-Identifier: Apache-2.0
// Excess over and shortfall below the band: nothing for a comparator on the board, a sample's worth for one
// in the controller.
#include <gtest/gtest.h>

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
  // At standstill the current rises by 24 V * 30 us/0.572 mH = 1.26 A per sample: a figure of the band would
  // mislead.
  Scenario s = current_square();
  s.control.current = {.type = CurrentLoopType::hysteresis, .band_A = 0.2, .comparator = Comparator::sampled};
  ask(s, measure(MetricKind::band_excess, Signal::current));
  const auto out = run(s);
  ASSERT_FALSE(out);
  EXPECT_EQ(out.problems().front().where, "compare[0].metric");
}

}  // namespace SIXSTEP_TEST_FILE

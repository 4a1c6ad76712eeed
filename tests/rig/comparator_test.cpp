// SPDX-License-Identifier: Apache-2.0
// The board's event comparators (model.md 4) trip only if the current exceeds a level, not if it is equal to
// the level. Between the levels they keep their state. A board has one comparator, or one comparator per
// phase.
#include <gtest/gtest.h>

#include "tests/support/modulating.hpp"

namespace SIXSTEP_TEST_FILE {

using namespace sixstep;
using namespace sixstep::testing;

TEST(Comparator, StartsOnAndSwitchesStrictlyBeyondItsLevels) {
  SixStepModulator m{ModulatorConfig{}};
  m.start_period(at(0), compared(Watch::motor, Chopping::soft, 5.0));
  EXPECT_EQ(on(m), "a+b-");
  EXPECT_FALSE(m.compare(at(1), plant::PerLeg<double>{5.25, -5.25, 0.0}));
  EXPECT_TRUE(m.compare(at(2), plant::PerLeg<double>{5.5, -5.25, -0.25}));
  EXPECT_EQ(on(m), "b-");
  EXPECT_FALSE(m.compare(at(3), plant::PerLeg<double>{4.75, -4.75, 0.0}));
  EXPECT_TRUE(m.compare(at(4), plant::PerLeg<double>{4.5, -4.75, 0.25}));
  EXPECT_EQ(on(m), "a+b-");
  EXPECT_FALSE(m.comparator(1).armed) << "one comparator on the motor current";
}

TEST(Comparator, OfEachPhaseSwitchesItsOwnSwitch) {
  SixStepModulator m{ModulatorConfig{}};
  m.start_period(at(0), compared(Watch::phase, Chopping::hard, 5.0));
  EXPECT_EQ(on(m), "a+b-");
  EXPECT_TRUE(m.compare(at(1), plant::PerLeg<double>{5.5, -5.0, -0.5}));
  EXPECT_EQ(on(m), "b-");
  EXPECT_TRUE(m.compare(at(2), plant::PerLeg<double>{5.0, -5.5, 0.5}));
  EXPECT_EQ(on(m), "");
  EXPECT_TRUE(m.compare(at(3), plant::PerLeg<double>{4.5, -4.5, 0.0}));
  EXPECT_EQ(on(m), "a+b-");
}

TEST(Comparator, SoftChoppingOnPhasesHasOnlyTheSourcesOne) {
  SixStepModulator m{ModulatorConfig{}};
  m.start_period(at(0), compared(Watch::phase, Chopping::soft, 5.0));
  EXPECT_TRUE(m.comparator(0).armed);
  EXPECT_FALSE(m.comparator(1).armed);
  EXPECT_EQ(m.comparator_weights(0), (plant::PerLeg<double>{1.0, 0.0, 0.0}));
}

TEST(Comparator, TicksNeitherRestartNorResetIt) {
  SixStepModulator m{ModulatorConfig{}};
  m.start_period(at(0), compared(Watch::motor, Chopping::soft, 5.0));
  m.compare(at(1), plant::PerLeg<double>{6.0, -6.0, 0.0});
  m.start_period(at(period), compared(Watch::motor, Chopping::soft, 5.0));
  EXPECT_EQ(on(m), "b-");
  EXPECT_TRUE(m.steady());
}

}  // namespace SIXSTEP_TEST_FILE

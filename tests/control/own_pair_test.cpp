// SPDX-License-Identifier: Apache-2.0
#include "sixstep/control/own/own_pair.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace SIXSTEP_TEST_FILE {

using namespace sixstep;

/// Torque per ampere of a pair: the difference of the back-EMF shapes of its two phases in the middle of a
/// sector. The shape of the positive pair's source is +1, the shape of its sink is -1
/// (docs/reference/model.md 3).
double torque_per_ampere(std::uint8_t sector, const sixstep_answer& a) {
  const control::Pair positive = control::positive_pair(sector);
  const auto shape = [&](int leg) {
    return leg == static_cast<int>(positive.source) ? 1.0
           : leg == static_cast<int>(positive.sink) ? -1.0
                                                    : 0.0;
  };
  return shape(a.source) - shape(a.sink);
}

TEST(OwnPair, TorqueHasTheSignOfTheDuty) {
  for (std::uint8_t sector = 0; sector < 6; ++sector)
    for (const double duty : {-1.0, -0.25, 0.0, 0.25, 1.0}) {
      sixstep_answer a{};
      control::command_pair(duty, control::hall_of_sector(sector), a);
      EXPECT_EQ(a.enabled, 1);
      EXPECT_EQ(a.duty, std::fabs(duty));
      EXPECT_EQ(torque_per_ampere(sector, a), duty < 0 ? -2.0 : 2.0);
    }
}

TEST(OwnPair, ABrokenProbesCodeTurnsTheBridgeOff) {
  for (const std::uint8_t code : {std::uint8_t{0b000}, std::uint8_t{0b111}}) {
    sixstep_answer a{};
    a.enabled = 1;
    control::command_pair(0.5, code, a);
    EXPECT_EQ(a.enabled, 0);
  }
}

TEST(OwnPair, WhatIsNoNumberStaysOneForTheCheckOfTheAnswer) {
  sixstep_answer a{};
  control::command_pair(std::nan(""), 0b100, a);
  EXPECT_TRUE(std::isnan(a.duty));
}

TEST(OwnPair, ACommandComesBackFromItsAnswer) {
  control::BridgeCommand<double> given{};
  given.enabled = true;
  given.pair = {control::Leg::c, control::Leg::a};
  given.duty = 0.375;
  given.overlap = 0.25;
  given.chopping = control::Chopping::complementary;
  given.chopped = control::ChoppedSwitch::lower;
  sixstep_answer answer{};
  control::answer_pair(given, answer);
  const control::BridgeCommand<double> back = control::pair_command(answer);
  EXPECT_TRUE(back.enabled);
  EXPECT_EQ(back.pair.source, given.pair.source);
  EXPECT_EQ(back.pair.sink, given.pair.sink);
  EXPECT_EQ(back.duty, given.duty);
  EXPECT_EQ(back.overlap, given.overlap);
  EXPECT_EQ(back.chopping, given.chopping);
  EXPECT_EQ(back.chopped, given.chopped);
}

}  // namespace SIXSTEP_TEST_FILE

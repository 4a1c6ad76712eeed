// SPDX-License-Identifier: Apache-2.0
#include "sixstep/control/commutation.hpp"

#include <gtest/gtest.h>

#include "sixstep/plant/hall.hpp"

namespace SIXSTEP_TEST_FILE {

using namespace sixstep::control;

TEST(Commutation, TableIsTheModels) {
  // The table of model.md 3: H1 H2 H3 and the driven pair of sectors 0 to 5.
  constexpr std::uint8_t code[] = {0b100, 0b110, 0b010, 0b011, 0b001, 0b101};
  constexpr Pair pair[] = {{Leg::a, Leg::b}, {Leg::a, Leg::c}, {Leg::b, Leg::c},
                           {Leg::b, Leg::a}, {Leg::c, Leg::a}, {Leg::c, Leg::b}};
  for (std::uint8_t s = 0; s < 6; ++s) {
    EXPECT_EQ(sector_of_hall(code[s]), s);
    EXPECT_EQ(positive_pair(s), pair[s]);
  }
}

TEST(Commutation, NoSectorForCodesThatProbes120DegreesApartCannotGive) {
  EXPECT_EQ(sector_of_hall(0b000), no_sector);
  EXPECT_EQ(sector_of_hall(0b111), no_sector);
  for (int code = 8; code < 256; ++code)
    EXPECT_EQ(sector_of_hall(static_cast<std::uint8_t>(code)), no_sector) << code;
}

TEST(Commutation, DecodesWhatTheProbesSay) {
  for (int s = 0; s < 6; ++s) EXPECT_EQ(sector_of_hall(sixstep::plant::hall_code(s)), s);
}

TEST(Commutation, NeighbouringSectorsDifferInOneProbeAndOneLeg) {
  for (std::uint8_t s = 0; s < 6; ++s) {
    const std::uint8_t next = static_cast<std::uint8_t>((s + 1) % 6);
    EXPECT_EQ(__builtin_popcount(sixstep::plant::hall_code(s) ^ sixstep::plant::hall_code(next)), 1);
    const Pair p = positive_pair(s), q = positive_pair(next);
    EXPECT_EQ(int{p.source == q.source} + int{p.sink == q.sink}, 1);
    EXPECT_EQ(swapped(p), positive_pair(static_cast<std::uint8_t>((s + 3) % 6)));
  }
}

TEST(Commutation, MotorCurrentIsHalfTheDifferenceOfThePair) {
  constexpr Measurement<double> m{.i_a_A = 5.0, .i_b_A = -2.0, .i_c_A = -3.0};
  static_assert(motor_current(m, positive_pair(0)) == 3.5);
  static_assert(motor_current(m, positive_pair(1)) == 4.0);
  static_assert(motor_current(m, positive_pair(2)) == 0.5);
  static_assert(motor_current(m, positive_pair(3)) == -3.5);
  static_assert(motor_current(m, positive_pair(4)) == -4.0);
  static_assert(motor_current(m, positive_pair(5)) == -0.5);
}

TEST(StayingPhase, IsTheOneThatBothPairsHave) {
  StayingPhase state;
  Measurement<double> m{.i_a_A = 3, .i_b_A = -2, .i_c_A = -1};  // a and c carry the current of b
  EXPECT_EQ(staying_current(state, m, 0), 3.0);                 // a to b: there was no earlier pair
  EXPECT_EQ(staying_current(state, m, 1), 3.0);                 // a to c: a stays
  m = {.i_a_A = 1, .i_b_A = 2, .i_c_A = -3};
  EXPECT_EQ(staying_current(state, m, 2), 3.0);  // b to c: c stays, and its current decays
  EXPECT_EQ(staying_current(state, m, 2), 3.0);
  EXPECT_EQ(staying_current(state, m, 1), 3.0);  // reversed, a to c: c stays
  m = {.i_a_A = -5, .i_b_A = 0, .i_c_A = 5};
  EXPECT_EQ(staying_current(state, m, 4), 5.0);  // c to a has no leg in common with b to c: the source's
                                                 // current
}

}  // namespace SIXSTEP_TEST_FILE

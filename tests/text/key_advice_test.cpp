// SPDX-License-Identifier: Apache-2.0
#include "text/keys/key_advice.hpp"

#include <gmock/gmock.h>

#include <vector>

namespace text {
namespace SIXSTEP_TEST_FILE {

TEST(EditDistance, CountsInsertionsDeletionsReplacementsAndSwaps) {
  EXPECT_EQ(edit_distance("", ""), 0);
  EXPECT_EQ(edit_distance("abc", ""), 3);
  EXPECT_EQ(edit_distance("", "abc"), 3);
  EXPECT_EQ(edit_distance("kitten", "sitting"), 3);
  EXPECT_EQ(edit_distance("dampnig", "damping"), 1);
  EXPECT_EQ(edit_distance("centre", "center"), 1);
}

TEST(Nearest, AnswersOnlyWhatMayBeMeant) {
  const std::vector<std::string> known{"voltage_V", "resistance_ohm", "sinks"};
  EXPECT_EQ(nearest("voltge_V", known), "voltage_V");
  EXPECT_EQ(nearest("sink", known), "sinks");
  EXPECT_EQ(nearest("colour", known), "");
}

TEST(NearestWord, AUnitMayBeLeftOutOrWrong) {
  const std::vector<std::string> known{"current", "u_ab_V", "i_m_A", "energy_J", "rise_time_s"};
  EXPECT_EQ(nearest_word("u_ab", known), "u_ab_V");
  EXPECT_EQ(nearest_word("i_m", known), "i_m_A");
  EXPECT_EQ(nearest_word("energy_mJ", known), "energy_J");
  EXPECT_EQ(nearest_word("curent", known), "current");
  EXPECT_EQ(nearest_word("risetime", known), "rise_time_s");
  EXPECT_EQ(nearest_word("colour", known), "");
}

TEST(WithoutUnit, DropsTheUnitOnly) {
  EXPECT_EQ(without_unit("no_load_speed_rad_s"), "no_load_speed");
  EXPECT_EQ(without_unit("gain_rad_s_per_deg"), "gain");
  EXPECT_EQ(without_unit("pole_pairs"), "pole_pairs");
  EXPECT_EQ(without_unit("s"), "s");
}

TEST(LimitOf, SaysTheRangeInWords) {
  EXPECT_EQ(limit_of({}), "must be a finite number");
  EXPECT_EQ(limit_of(base::above(0)), "must be above 0");
  EXPECT_EQ(limit_of(base::from(1)), "must be at least 1");
  EXPECT_EQ(limit_of(base::between(0, 1)), "must lie in 0 to 1");
  EXPECT_EQ(limit_of(base::strictly_between(0, 180)), "must lie strictly between 0 and 180");
  EXPECT_EQ(limit_of({0, 1, false, true}), "must be above 0 and at most 1");
}

}  // namespace SIXSTEP_TEST_FILE
TEST(KeyAdvice, NamesEachKnownKeyOnce) {
  const std::vector<std::string> known{"speed_rad_s", "speed_rad_s", "bus_V"};
  EXPECT_EQ(text::unknown_key("zzz", known, "").cure, "known are speed_rad_s, bus_V");
}

}  // namespace text

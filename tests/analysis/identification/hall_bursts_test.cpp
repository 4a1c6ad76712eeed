// SPDX-License-Identifier: Apache-2.0
// A burst of edges counts as one event, for any number of rows. A burst is caused by a contact that is loose
// for a moment, or by an edge that bounces.
#include <gmock/gmock.h>

#include "sixstep/analysis/identification/hall/hall_edges.hpp"
#include "tests/analysis/identification/drilled.hpp"

namespace SIXSTEP_TEST_FILE {

using namespace sixstep;
using namespace sixstep::testing;
using analysis::HallEdges;
using analysis::HallLog;
using Code = std::uint8_t;

/// Adds bursts on line H1 to the log: in the first `turns` sectors with the code `at`, H1 is wrong in every
/// other row of the middle 24 rows.
HallLog loose(HallLog log, Code at, int turns) {
  const std::vector<Code> clean = log.codes;
  for (std::size_t n = 1; n < clean.size() && turns > 0; ++n) {
    if (clean[n] != at || clean[n - 1] == at || n + 40 > clean.size()) continue;
    for (std::size_t row = n + 6; row < n + 30; row += 2) log.codes[row] ^= 0b100;
    --turns;
  }
  return log;
}

void expect_same_way(const HallLog& clean, const HallLog& broken) {
  const auto expected = analysis::hall_edges(clean), found = analysis::hall_edges(broken);
  ASSERT_TRUE(expected && found) << to_string(found.problems()[0]);
  EXPECT_EQ(found->mask, 0);
  EXPECT_GT(found->mask_probability, 0.99);
  EXPECT_GT(found->glitches, 10u);
  ASSERT_EQ(found->edges.size(), expected->edges.size());
  for (std::size_t n = 0; n < expected->edges.size(); ++n) {
    EXPECT_EQ(found->edges[n].boundary, expected->edges[n].boundary);
    EXPECT_EQ(found->edges[n].t_s, expected->edges[n].t_s);
  }
}

/// Code 000 is impossible with probes 120 degrees apart. It occurs 36 times, codes 010 and 101 occur 12
/// times. A count of single edges would therefore indicate probes 60 degrees apart.
TEST(HallBursts, ImpossibleCodesOfALooseContactCountOncePerBurst) {
  const HallLog clean = drawn_log(drilled()).log;
  expect_same_way(clean, loose(clean, 0b100, 3));
}

/// H1 changes 96 times, an intact line 24 times. The intact line must not be reported as dead.
TEST(HallBursts, ABurstOnOneLineMakesNoOtherOneDead) {
  HallLog broken = drawn_log(drilled()).log;
  for (int n = 0; n < 2; ++n) broken = loose(broken, n == 0 ? 0b100 : 0b110, 5);
  expect_same_way(drawn_log(drilled()).log, broken);
}

/// A rotor that oscillates around one edge changes one line; the two other lines are constant.
TEST(HallBursts, LinesThatNeverChangeAreToldHoweverOftenTheThirdDoes) {
  HallLog log = drawn_log(drilled()).log;
  for (std::size_t n = 0; n < log.codes.size(); ++n) log.codes[n] = n / 20 % 2 == 0 ? 0b100 : 0b110;
  const auto found = analysis::hall_edges(log);
  ASSERT_FALSE(found);
  ASSERT_EQ(found.problems().size(), 2u);
  EXPECT_THAT(to_string(found.problems()[0]),
              ::testing::HasSubstr("hall1 = 1 in every row, while another line changes "));
  EXPECT_THAT(to_string(found.problems()[1]), ::testing::HasSubstr("hall3 = 0 in every row"));
}

}  // namespace SIXSTEP_TEST_FILE

// SPDX-License-Identifier: Apache-2.0
// The random scenarios of the standard tests, always with the same seeds. ctest --preset long uses new seeds.
#include <gtest/gtest.h>

#include "tests/fuzz/campaign.hpp"
#include "tests/fuzz/draw.hpp"

namespace SIXSTEP_TEST_FILE {

using namespace sixstep::testing;

#if defined(__SANITIZE_ADDRESS__)
constexpr std::uint64_t valid_count = 400, hostile_count = 600;
#else
constexpr std::uint64_t valid_count = 600, hostile_count = 6000;
#endif

CampaignResult all_hold(const char* name, Examined (*examine)(std::uint64_t), std::uint64_t count) {
  const Seeds range = seeds(count);
  const CampaignResult result = carry_out({name, examine, range.first, range.count, 2});
  for (const CampaignResult::Broken& b : result.broken)
    ADD_FAILURE() << "SIXSTEP_FUZZ_SEED=" << b.seed << ": " << b.law << " (" << b.part << ")\n" << b.words;
  return result;
}

TEST(DrawnScenarios, KeepTheLawsInEveryFirmwareAndArithmetic) {
  const CampaignResult result = all_hold("valid", examine_drawn, valid_count);
  if (std::getenv("SIXSTEP_FUZZ_SEED")) return;
  EXPECT_GT(result.accepted, 2 * result.refused) << "most of what is drawn must be worth a run";
  EXPECT_EQ(result.kinds.size(), 26u) << "four firmwares in six arithmetics, the field-oriented one in two";
}

/// Both kinds of result must occur. Otherwise the test would cover only half of the reader.
TEST(HostileScenarios, AreRefusedWithWordsOrRunToNumbers) {
  const CampaignResult result = all_hold("hostile", examine_hostile, hostile_count);
  if (std::getenv("SIXSTEP_FUZZ_SEED")) return;
  EXPECT_GT(result.accepted, hostile_count / 20);
  EXPECT_GT(result.refused, hostile_count / 3);
}

}  // namespace SIXSTEP_TEST_FILE

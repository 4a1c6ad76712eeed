// SPDX-License-Identifier: Apache-2.0
// No accepted scenario can cause a fault of this kind: bridge commands never name a leg twice, and probes
// never fail. This test therefore calls the function that computes the exit code of a fault.
#include "faces/cli/exit_code.hpp"

#include <gtest/gtest.h>

namespace cli {
namespace SIXSTEP_TEST_FILE {

study::Outcome judged(bool ok) {
  study::Outcome outcome;
  outcome.verdicts = {{"figure", "A", 1.0, std::nullopt, 2.0, ok}};
  return outcome;
}

study::Outcome faulted(bool ok) {
  study::Outcome outcome = judged(ok);
  outcome.fault = base::Problem{.where = "t = 0.001 s", .value = {}, .limit = "shoot-through", .cure = {}};
  return outcome;
}

TEST(ExitCode, IsWhatTheHelpPromises) {
  EXPECT_EQ(static_cast<int>(exit_of(judged(true))), 0);
  EXPECT_EQ(static_cast<int>(exit_of(judged(false))), 1);
  EXPECT_EQ(static_cast<int>(Exit::bad_input), 2);
  EXPECT_EQ(static_cast<int>(exit_of(faulted(true))), 3);
  EXPECT_EQ(static_cast<int>(Exit::internal), 4);
}

TEST(ExitCode, AFaultIsGraverThanAMissedRequirement) {
  EXPECT_EQ(exit_of(faulted(false)), Exit::fault);
  EXPECT_EQ(graver(exit_of(judged(false)), exit_of(faulted(true))), Exit::fault);
  EXPECT_EQ(graver(exit_of(faulted(true)), exit_of(judged(true))), Exit::fault);
}

}  // namespace SIXSTEP_TEST_FILE
}  // namespace cli

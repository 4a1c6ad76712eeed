// SPDX-License-Identifier: Apache-2.0
#include "batch/for_each.hpp"

#include <gmock/gmock.h>

#include <stdexcept>
#include <vector>

namespace batch {
namespace SIXSTEP_TEST_FILE {

TEST(ForEach, DoesEachWorkOnce) {
  for (const unsigned jobs : {0U, 1U, 3U, 64U}) {
    std::vector<int> done(40, 0);
    for_each(done.size(), jobs, [&](std::size_t n) { ++done[n]; });
    EXPECT_THAT(done, ::testing::Each(1)) << jobs;
  }
  for_each(0, 4, [](std::size_t) { FAIL(); });
}

TEST(ForEach, ThrowsTheFirstExceptionAfterAllEnded) {
  std::vector<int> done(8, 0);
  EXPECT_THROW(for_each(done.size(), 2,
                        [&](std::size_t n) {
                          done[n] = 1;
                          if (n == 3) throw std::runtime_error("third");
                        }),
               std::runtime_error);
  EXPECT_THAT(done, ::testing::Each(1));
}

}  // namespace SIXSTEP_TEST_FILE
}  // namespace batch

// SPDX-License-Identifier: Apache-2.0
#include "files/trace/matio.hpp"

#include <gmock/gmock.h>

namespace files {
namespace {

TEST(Matio, IsLoadedOnceWithAllItsFunctions) {
  ASSERT_TRUE(matio()) << to_string(matio().problems().front());
  EXPECT_NE(matio()->VarWriteAppend, nullptr);
  EXPECT_EQ(&matio(), &matio());
}

TEST(Matio, WhereItIsMissingSaysSoAndWhatToDo) {
  const base::Result<Matio> none = load_matio("libmatio.so.none");
  ASSERT_FALSE(none);
  EXPECT_THAT(to_string(none.problems().front()),
              testing::AllOf(testing::HasSubstr("libmatio.so.none"), testing::HasSubstr("libmatio11"),
                             testing::HasSubstr("--csv")));
}

/// Any library is not the one: this has none of the functions.
TEST(Matio, AnotherLibraryIsRefused) { EXPECT_FALSE(load_matio("libm.so.6")); }

}  // namespace
}  // namespace files

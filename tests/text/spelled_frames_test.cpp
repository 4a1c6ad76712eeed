// SPDX-License-Identifier: Apache-2.0
// If a spelling determines the frame, its explanation states only this frame. Templates and help pages must
// not offer a choice that the reader refuses.
#include <gmock/gmock.h>

#include "text/keys/key_catalog.hpp"
#include "text/keys/key_tree.hpp"
#include "text/motor/motor_template.hpp"

namespace text {
namespace SIXSTEP_TEST_FILE {

using ::testing::AnyOf;
using ::testing::HasSubstr;
using ::testing::Not;

TEST(SpelledFrames, AFixedFrameHasAMeaningOfItsOwn) {
  int fixed = 0;
  for (const KeyEntry& key : sheet_keys()) {
    if (frames_of(key.about.frame).size() < 2) continue;
    for (const base::Spelling& spelling : key.about.also) {
      if (frames_of(spelling.frame).size() != 1) continue;
      ++fixed;
      const std::string meaning(meaning_of(spelled(key, spelling)));
      EXPECT_NE(meaning, meaning_of(key)) << spelling.key;
      EXPECT_THAT(meaning, Not(AnyOf(HasSubstr("one phase"), HasSubstr("rms"), HasSubstr("peak"))))
          << spelling.key;
    }
  }
  EXPECT_EQ(fixed, 4);  // lines 6, 10, 11 and 13 of maxon's sheets
}

TEST(SpelledFrames, TheTemplateOfNumberedLinesOffersNoFrame) {
  const auto text = motor_template("maxon", "mine");
  ASSERT_TRUE(text);
  for (const char* choice : {"one phase", "rms", "peak", "frame"}) EXPECT_THAT(*text, Not(HasSubstr(choice)));
}

}  // namespace SIXSTEP_TEST_FILE
}  // namespace text

// SPDX-License-Identifier: Apache-2.0
// For each of these namespaces, an exported header compiles. Any other name is refused.
#include "text/export/name_space.hpp"

#include <gtest/gtest.h>

namespace SIXSTEP_TEST_FILE {

TEST(NameSpace, NamesThatCompileAreTaken) {
  for (const char* name : {"exported", "left::wheel", "a", "A9::b_2::c", "_x", "int8", "klass", "stdx"})
    EXPECT_TRUE(text::is_name_space(name)) << name;
}

TEST(NameSpace, WordsOfTheLanguageAndNamesThatTheHeaderUsesAreRefused) {
  for (const char* name :
       {"int", "class",    "std",     "left::int", "std::x", "left::std", "sixstep", "sixstep::control",
        "and", "co_await", "char8_t", "main",      "linux",  "__x",       "a__b",    "_X",
        "",    "::",       "a::",     "::a",       "a:b",    "a:::b",     "7up",     "a::7up",
        "a b", "a-b",      "\xc3\xbc"})
    EXPECT_FALSE(text::is_name_space(name)) << name;
}

}  // namespace SIXSTEP_TEST_FILE

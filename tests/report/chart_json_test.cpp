// SPDX-License-Identifier: Apache-2.0
// The writer of chart data writes the same bytes as the JSON library.
#include "report/chart_json.hpp"

#include <gtest/gtest.h>

namespace SIXSTEP_TEST_FILE {

using report::dumped;
using report::json;

TEST(Dumped, IsWhatTheLibraryWrites) {
  std::string base64(1000, 'A');
  base64 += "+/==";
  json page{{"empty", json::object()},
            {"none", json::array()},
            {"null", nullptr},
            {"numbers", {0, -1, 1.5, 1e-300, 0.1, 1e22, true, false}},
            {"base64", base64},
            {"quoted", "a \"b\" \\ c\n\t\x01"},
            {"signs", "\u00e4 \u03c9 \U0001F600 </script>"},
            {"no UTF-8", "a\xff\xc3z"},
            {"del", "\x7f"},
            {"key \"quoted\" \u00b0", {{{"deep", {json::array({json::array(), json::object()})}}}}}};
  page["order"] = {{"z", 1}, {"a", 2}};
  EXPECT_EQ(dumped(page), page.dump(-1, ' ', false, json::error_handler_t::replace));
  for (const json& part : page)
    EXPECT_EQ(dumped(part), part.dump(-1, ' ', false, json::error_handler_t::replace));
}

}  // namespace SIXSTEP_TEST_FILE

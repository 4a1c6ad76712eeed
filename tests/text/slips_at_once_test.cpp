// SPDX-License-Identifier: Apache-2.0
// A motor file and a scenario have several mistakes of several kinds. One run reports all mistakes, but does
// not report a consequence of another mistake.
#include <gmock/gmock.h>

#include <string>
#include <vector>

#include "tests/text/scenario_folder.hpp"

namespace text {
namespace SIXSTEP_TEST_FILE {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

class SlipsAtOnce : public ScenarioFolder {
 protected:
  /// The messages about a motor file.
  std::vector<std::string> told(const std::string& text) {
    write("m.toml", text);
    const base::Result<design::Sheet> sheet = files::read_sheet((folder_ / "m.toml").string());
    std::vector<std::string> lines;
    if (!sheet)
      for (const base::Problem& problem : sheet.problems()) lines.push_back(to_string(problem));
    return lines;
  }
};

/// Mistakes in one key, in a unit, and between two keys are reported together, in the order of the lines.
TEST_F(SlipsAtOnce, AllSlipsAreToldAtOnce) {
  const std::string sheet =
      "name = \"m\"\npole_pairs = 8\npolar = 3\nresistance_ohm = 1.03\ninductance_mH = \"0.572 mF\"\n"
      "torque_constant_mNm_A = 33.5\nback_emf_mV_s = 16\ninertia_gcm2 = -135\ninertias = 4\n"
      "cogging_orders = [13]\ncogging_mNm = [1, 2]\n";
  const std::vector<::testing::Matcher<std::string>> all = {
      HasSubstr(":3:1: polar is not a key here; "),
      HasSubstr(":4:18: resistance_ohm = 1.03 must say its frame"),
      HasSubstr(":5:17: inductance_mH = \"0.572 mF\" has the unit mF"),
      HasSubstr(":7:17: back_emf_mV_s = 16 contradicts torque_constant_mNm_A, which means 16.75; remove one"),
      HasSubstr(":8:16: inertia_gcm2 = -135 must be above 0; it means: moment of inertia"),
      HasSubstr(":9:1: inertias is not a key here; "),
      HasSubstr(":10:18: cogging_orders = 13 must be a multiple of the number of poles, 16; "),
      HasSubstr(":11:15: cogging_mNm = 2 values needs one value for each of the 1 cogging_orders; "),
  };
  EXPECT_THAT(told(sheet), ::testing::ElementsAreArray(all));
  // A consequence is not reported: after the misspelt key is corrected, both axes are given.
  EXPECT_THAT(told("name = \"m\"\nd_axis_inductance_mH = 1\nq_axis_inductence_mH = 2\n"),
              ElementsAre(HasSubstr("q_axis_inductence_mH is not a key here; did you mean")));
}

/// The mistakes of a scenario are reported together with the mistakes of its motor file and of
/// [motor_override].
TEST_F(SlipsAtOnce, AScenarioTellsItsOwnSlipsBesideItsMotors) {
  write("bad.toml", "name = \"m\"\npolar = 3\nresistance_ohm = 1.03\n");
  EXPECT_THAT(complaints("motor = \"bad.toml\"\nduration_s = 0.02\n[bridge]\ndead_time_s = 1\n[[at]]\n"
                         "time_s = 3\nload = { torque_Nm = 1 }\n[control]\nmode = \"current\"\n"
                         "current = { settle_ms = 1 }\n"),
              ElementsAre(HasSubstr("x.toml:4:15: bridge.dead_time_s = 1 must be shorter than"),
                          HasSubstr("x.toml:6:10: at.time_s = 3 is not before the end of the run"),
                          HasSubstr("x.toml:10:13: control.current.settle_ms is not a key here"),
                          HasSubstr("bad.toml:2:1: polar is not a key here"),
                          HasSubstr("bad.toml:3:18: resistance_ohm = 1.03 must say its frame")));
  EXPECT_THAT(complaints("motor = \"maxon-251601\"\nduration_s = 0.02\n[bridge]\ndead_time_s = 1\n"
                         "[motor_override]\ninertia_gcm2 = -3\nfoo = 3\ntorque_constant_mNm_A = 33\n"
                         "back_emf_mV_s = 12\n"),
              ElementsAre(HasSubstr("x.toml:4:15: bridge.dead_time_s = 1 must be shorter than"),
                          HasSubstr("x.toml:6:16: motor_override.inertia_gcm2 = -3 must be above 0"),
                          HasSubstr("x.toml:7:1: motor_override.foo is not a key here"),
                          HasSubstr("x.toml:9:17: motor_override.back_emf_mV_s = 12 contradicts")));
}

}  // namespace SIXSTEP_TEST_FILE
}  // namespace text

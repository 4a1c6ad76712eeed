// SPDX-License-Identifier: Apache-2.0
// Tests the file of an exported session, tests/session/exported.toml, which every interface replays. Its
// first line contains the digest. SIXSTEP_RENEW=1 writes the file anew.
#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>
#include <sstream>

#include "files/scenario_on_disk.hpp"
#include "sixstep/base/written.hpp"
#include "sixstep/study/session/session.hpp"
#include "text/scenario/scenario_text.hpp"

namespace SIXSTEP_TEST_FILE {

using namespace sixstep;
using namespace sixstep::study;

const std::string source = SIXSTEP_SOURCE_DIR;

/// A session with one change of each kind.
std::string exported() {
  const auto scenario = text::read_scenario_text(source + "/data/scenarios/opened.toml", R"(
motor = "maxon-251601"
duration_s = 0.02
control = { mode = "current", current = { settle_s = 1e-3 } }
reference = { shape = "square", high = 5, low = -5, period_s = 0.01 }
)");
  EXPECT_TRUE(scenario) << to_string(scenario.problems().at(0));
  auto session = Session::open(*scenario, {.keep_books = false});
  const auto tell = [&](double at_s, const At& at) {
    session->advance(at_s);
    const auto when = session->change(at);
    EXPECT_TRUE(when) << to_string(when.problems().at(0));
  };
  At board, gains, load, speed;
  board.supply.voltage_V = 22.5;
  board.bridge.dead_time_s = 1e-6;
  board.pwm.chopping = AtChopping::complementary;
  gains.control.current.settle_s = 1.5e-3;
  load.load.torque_Nm = 0.01;
  load.reference = Reference{.shape = Shape::sine, .amplitude = 3.0, .frequency_Hz = 200.0};
  speed.control.mode = AtMode::speed;
  speed.control.speed.settle_s = 20e-3;
  speed.reference = Reference{.value = 50.0};
  tell(1.3e-3, board);
  tell(4.7e-3, gains);
  tell(8e-3, load);
  tell(12.34e-3, speed);
  session->advance(18e-3);
  const auto out = session->close();
  EXPECT_TRUE(out) << to_string(out.problems().at(0));
  return text::scenario_text(session->scenario(), {"SPDX-License-Identifier: Apache-2.0",
                                                   "digest " + base::written_hex(out->digest)});
}

TEST(ExportedSession, TheFileIsWhatTheSessionWrites) {
  const std::string name = source + "/tests/session/exported.toml", now = exported();
  if (std::getenv("SIXSTEP_RENEW")) std::ofstream(name) << now;
  std::ifstream file(name);
  std::stringstream kept;
  kept << file.rdbuf();
  EXPECT_EQ(kept.str(), now) << "renew with SIXSTEP_RENEW=1";
}

TEST(ExportedSession, TheFileRunsToItsDigest) {
  const auto scenario = files::read_scenario(source + "/tests/session/exported.toml");
  ASSERT_TRUE(scenario) << to_string(scenario.problems().at(0));
  const auto out = run(*scenario);
  ASSERT_TRUE(out) << to_string(out.problems().at(0));
  std::ifstream file(source + "/tests/session/exported.toml");
  std::string licence, digest;
  std::getline(file, licence);
  std::getline(file, digest);
  EXPECT_EQ(digest, "# digest " + base::written_hex(out->digest));
}

}  // namespace SIXSTEP_TEST_FILE

// SPDX-License-Identifier: Apache-2.0
// The text, the table and the JSON of a measured frequency response contain the same numbers.
#include "text/results/bode_text.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <sstream>

#include "tests/support/scenarios.hpp"

namespace SIXSTEP_TEST_FILE {

using namespace sixstep;
using namespace sixstep::testing;
using ::testing::HasSubstr;
using ::testing::Not;

analysis::BodeStudy study_of(bool by_band) {
  study::Scenario s = maxon_scenario(control::Mode::current, 5.0);
  s.load.locked = true;
  if (by_band) s.control.current = {.type = study::CurrentLoopType::hysteresis, .band_A = 0.2};
  const auto b = analysis::study_bode(s);
  EXPECT_TRUE(b);
  return *b;
}

std::size_t lines_of(const std::string& text) {
  return static_cast<std::size_t>(std::count(text.begin(), text.end(), '\n'));
}

TEST(BodeText, TellsBothLoopsAndTheirMargins) {
  const analysis::BodeStudy s = study_of(false);
  const std::string text = text::bode_text("locked", s);
  EXPECT_THAT(text, HasSubstr("locked: current around 5 A, +-0.25 A\n"));
  EXPECT_THAT(text, HasSubstr("designed, dB"));
  EXPECT_THAT(text, HasSubstr("phase margin"));
  EXPECT_THAT(text, HasSubstr("of the response's rms is at frequencies that the multisine does not contain"));
  for (const text::BodeMargin& m : text::bode_margins(s)) EXPECT_THAT(text, HasSubstr(m.designed));
}

TEST(BodeText, WithoutALinearLoopSaysWhy) {
  const analysis::BodeStudy s = study_of(true);
  const std::string text = text::bode_text("band", s);
  EXPECT_THAT(
      text,
      HasSubstr(
          "no linear loop can be compared with the measurement: the current controller is a hysteresis, which is not linear"));
  EXPECT_THAT(text, Not(HasSubstr("designed")));
  EXPECT_THAT(text::bode_csv(s), Not(HasSubstr("designed")));
}

TEST(BodeText, TableAndJsonHoldTheSameNumbers) {
  const analysis::BodeStudy s = study_of(false);
  const std::string csv = text::bode_csv(s);
  EXPECT_EQ(lines_of(csv), s.points.size() + 1);
  const auto json = nlohmann::json::parse(text::bode_json("locked", s));
  ASSERT_EQ(json["points"].size(), s.points.size());
  std::istringstream rows(csv);
  std::string row;
  std::getline(rows, row);
  for (const auto& point : json["points"]) {
    ASSERT_TRUE(std::getline(rows, row));
    std::istringstream cells(row);
    for (const char* name : {"frequency_Hz", "gain_dB", "phase_deg", "coherence"}) {
      std::string cell;
      ASSERT_TRUE(std::getline(cells, cell, ','));
      EXPECT_EQ(std::stod(cell), point[name].get<double>()) << name;
    }
    // The designed phase is shifted by whole turns to the value nearest to the measured phase.
    EXPECT_LE(std::abs(point["designed_phase_deg"].get<double>() - point["phase_deg"].get<double>()), 180.0);
  }
  EXPECT_NEAR(json["measured"]["crossover_Hz"].get<double>() / json["designed"]["crossover_Hz"].get<double>(),
              1.0, 0.03);
}

// The measured phase is noisy and drifts over many turns. The designed phase must stay within one turn.
TEST(BodeText, DesignedPhaseDoesNotFollowAPhaseThatIsNoise) {
  analysis::BodeStudy s = study_of(false);
  const auto before = nlohmann::json::parse(text::bode_json("locked", s));
  for (analysis::LoopPoint& p : s.points) {
    p.coherence = analysis::little_coherence / 2;
    p.phase_rad += 10.0;
  }
  const auto after = nlohmann::json::parse(text::bode_json("locked", s));
  for (std::size_t n = 0; n < s.points.size(); ++n) {
    const double phase = after["points"][n]["designed_phase_deg"].get<double>();
    EXPECT_GT(phase, -360.0);
    EXPECT_LE(phase, 0.0);
    // The loop is unchanged, so the phases differ only by whole turns.
    const double turns = (phase - before["points"][n]["designed_phase_deg"].get<double>()) / 360.0;
    EXPECT_NEAR(turns, std::round(turns), 1e-9);
  }
}

}  // namespace SIXSTEP_TEST_FILE

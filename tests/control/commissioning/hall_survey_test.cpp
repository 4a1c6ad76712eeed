// SPDX-License-Identifier: Apache-2.0
#include "sixstep/control/commissioning/hall_survey.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdio>
#include <type_traits>

#include "tests/control/sensing/drawn.hpp"

namespace SIXSTEP_TEST_FILE {

using namespace sixstep::control;

static_assert(std::is_trivially_copyable_v<HallSurveyState>);

/// Probe k is high over half a turn. It is 120 k or 60 k degrees behind the first probe (model.md 3). `order`
/// assigns probes to pins.
struct Mounted {
  std::array<int, 3> order{0, 1, 2};
  unsigned inverted = 0;
  bool spaced_60 = false;

  std::uint8_t pins(int sector) const {
    unsigned code = 0;
    for (int pin = 0; pin < 3; ++pin) {
      const int lag = order[static_cast<std::size_t>(pin)] * (spaced_60 ? 1 : 2);
      const int since = ((sector - lag + 1) % 6 + 6) % 6;  // the first probe rises at the start of sector 5
      code |= (since < 3 ? 1u : 0u) << (2 - pin);
    }
    return static_cast<std::uint8_t>(code ^ inverted);
  }
};

struct Turn {
  double offset_deg = 0.0, lag_deg = 0.0;
  std::array<double, 6> own_deg{};
  int turns = 2, first = 0;

  /// A survey over `turns` turns of the field forward, then over as many turns backward. The angle of the
  /// field leads the d axis by the lag, in the direction of rotation.
  HallSurveyState survey(const HallSurveyConfig& config, const Mounted& mounted) const {
    HallSurveyState state;
    int sector = first;
    hall_survey_edge(config, state, mounted.pins(sector), 0, 0);
    for (const int way : {1, -1})
      for (int n = 0; n < 6 * turns; ++n) {
        const int edge = way > 0 ? sector + 1 : sector;
        sector += way;
        const double electrical =
            60.0 * edge + offset_deg + own_deg[static_cast<std::size_t>((edge % 6 + 6) % 6)] + way * lag_deg;
        hall_survey_edge(config, state, mounted.pins(sector), static_cast<std::int8_t>(way),
                         of_turns((electrical - 150.0) / 360.0));
      }
    return state;
  }
};

constexpr std::array<std::array<int, 3>, 6> orders = {
    {{0, 1, 2}, {1, 2, 0}, {2, 0, 1}, {0, 2, 1}, {2, 1, 0}, {1, 0, 2}}};

/// For every order, inversion, spacing and lag, the survey finds the table, the name of each line, and the
/// angle of each edge within two units.
TEST(HallSurvey, FindsEveryWiring) {
  const HallSurveyConfig config;
  for (const bool spaced_60 : {false, true})
    for (const auto& order : orders)
      for (unsigned inverted = 0; inverted < 8; ++inverted)
        for (const double offset : {-29.0, -12.5, 0.0, 8.0, 29.0}) {
          const Mounted mounted{order, inverted, spaced_60};
          const Turn turn{.offset_deg = offset, .lag_deg = 11.0, .own_deg = {0, 3, -2, 1, -4, 2}};
          const HallSurveyReading found = hall_survey_reading(config, turn.survey(config, mounted));
          ASSERT_EQ(found.verdict, HallSurvey::good);
          for (int s = 0; s < 6; ++s) {
            EXPECT_EQ(found.lines.sector[mounted.pins(s)], s);
            EXPECT_EQ(as_wired(found.lines, mounted.pins(s)), hall_of_sector(static_cast<std::uint8_t>(s)));
            const double at = found.edges.at[s] * (360.0 / 4294967296.0);
            const double due = 60.0 * s + offset + turn.own_deg[static_cast<std::size_t>(s)];
            EXPECT_NEAR(std::remainder(at - due, 360.0), 0.0, 2 * 360.0 / 4294967296.0);
          }
          EXPECT_NEAR(degrees_of(found.offset), offset, 1e-6);
          EXPECT_NEAR(degrees_of(found.lag), 11.0, 1e-6);
          for (int pin = 0; pin < 3 && !spaced_60; ++pin)
            EXPECT_EQ(found.lines.probe[pin], order[static_cast<std::size_t>(pin)] + 1);
          EXPECT_TRUE(spaced_60 || found.lines.inverted == inverted);
          if (order == orders[0] && inverted == 0) {
            EXPECT_TRUE(found.plain);
            EXPECT_EQ(found.config.arrangement,
                      spaced_60 ? HallArrangement::degrees_60 : HallArrangement::degrees_120);
          }
        }
}

/// A wiring that hall.hpp decodes directly needs no table. The survey sets `plain` for these wirings, 4 of
/// 96. Both ways of decoding agree.
TEST(HallSurvey, PlainOnesAreThoseThatHallDecodes) {
  const HallSurveyConfig config;
  int plain = 0;
  for (const bool spaced_60 : {false, true})
    for (const auto& order : orders)
      for (unsigned inverted = 0; inverted < 8; ++inverted) {
        const Mounted mounted{order, inverted, spaced_60};
        const HallSurveyReading found = hall_survey_reading(config, Turn{}.survey(config, mounted));
        if (!found.plain) continue;
        ++plain;
        for (int s = 0; s < 6; ++s)
          EXPECT_EQ(sector_of_hall(as_120_degrees(found.config.arrangement, mounted.pins(s))), s);
      }
  EXPECT_EQ(plain, 4);  // both arrangements: straight, or equal to the other arrangement with one line
                        // inverted and two lines crossed
}

TEST(HallSurvey, NamesWhatIsWrong) {
  const HallSurveyConfig config;
  const Mounted mounted;
  HallSurveyState dead;
  hall_survey_edge(config, dead, mounted.pins(0) & 0b101, 0, 0);
  for (const int way : {1, -1})
    for (int n = 0; n <= 12; ++n)
      hall_survey_edge(config, dead, mounted.pins(way * n) & 0b101, static_cast<std::int8_t>(way),
                       of_turns((60.0 * way * n - 150) / 360));
  const HallSurveyReading silent = hall_survey_reading(config, dead);
  EXPECT_EQ(silent.verdict, HallSurvey::dead_line);
  EXPECT_EQ(silent.dead_pins, 0b010);
  EXPECT_EQ(hall_survey_reading(config, {}).verdict, HallSurvey::dead_line);

  HallSurveyState slipped = Turn{}.survey(config, mounted);
  hall_survey_edge(config, slipped, mounted.pins(1), 1, of_turns((60.0 + 40 - 150) / 360));
  EXPECT_EQ(hall_survey_reading(config, slipped).verdict, HallSurvey::not_steady);

  HallSurveyState half = Turn{}.survey({.turns = 2}, mounted);
  EXPECT_EQ(hall_survey_reading({.turns = 4}, half).verdict, HallSurvey::not_steady);
}

}  // namespace SIXSTEP_TEST_FILE

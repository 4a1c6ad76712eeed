// SPDX-License-Identifier: Apache-2.0
// Every shipped run obeys the laws of model.md 5 and has its shipped verdict.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "files/scenario_on_disk.hpp"
#include "sixstep/study/run/run.hpp"

namespace text {
namespace SIXSTEP_TEST_FILE {

namespace fs = std::filesystem;
using namespace sixstep;

std::vector<std::string> shipped_scenarios() {
  std::vector<std::string> files;
  for (const fs::directory_entry& entry :
       fs::recursive_directory_iterator(fs::path(SIXSTEP_SOURCE_DIR) / "data" / "scenarios"))
    if (entry.path().extension() == ".toml") files.push_back(entry.path().string());
  std::sort(files.begin(), files.end());
  return files;
}

/// Returns true if a monitored resolver fails or an index is false. A stuck encoder line is detected only at
/// an index.
bool loses_sensor(const study::Scenario& s) {
  return s.sensors.watched && std::any_of(s.at.begin(), s.at.end(), [](const study::At& at) {
           return at.sensors.false_index || at.sensors.excitation ||
                  at.sensors.broken_winding != study::Winding::none;
         });
}

/// Returns true if a lean drive has an inverted line, or a line that becomes stuck at an instant. Both cause
/// an impossible code.
bool misleads(const study::Scenario& s) {
  if (s.control.drive != study::FirmwareKind::lean) return false;
  using enum study::HallLines;
  const study::HallLines inverted = s.sensors.hall_inverted;
  return inverted == line_1 || inverted == line_2 || inverted == line_3 ||
         std::any_of(s.at.begin(), s.at.end(),
                     [](const study::At& at) { return at.sensors.hall_break.has_value(); });
}

class EveryShippedRun : public ::testing::TestWithParam<std::string> {};

TEST_P(EveryShippedRun, ObeysTheStandingLaws) {
  const auto scenario = files::read_scenario(GetParam());
  ASSERT_TRUE(scenario);
  double last_s = 0.0;
  bool time_holds = true, complete = true;
  const auto outcome = study::run(*scenario, {.on_event = [&](study::Row row) {
    time_holds = time_holds && row[0] >= last_s;
    last_s = row[0];
    for (const std::size_t state : {1, 2, 3, 13, 14, 16}) complete = complete && std::isfinite(row[state]);
  }});
  ASSERT_TRUE(outcome) << to_string(outcome.problems().front());
  EXPECT_TRUE(time_holds) << "time went back";
  EXPECT_TRUE(complete) << "a current, speed, angle or bus voltage is not a number";
  // The run of a lean drive ends if its lines give no position. Only scenarios about such lines may end in
  // this way.
  const bool misled = misleads(*scenario) || loses_sensor(*scenario);
  if (misled) {
    ASSERT_TRUE(outcome->fault);
    EXPECT_NE(
        to_string(*outcome->fault).find(loses_sensor(*scenario) ? "resolver" : "Hall code is impossible"),
        std::string::npos);
    EXPECT_LT(last_s, scenario->duration_s);
  } else {
    EXPECT_DOUBLE_EQ(last_s, scenario->duration_s);
  }
  EXPECT_LE(std::fabs(outcome->energy->electrical_residual), 1e-11);
  EXPECT_LE(std::fabs(outcome->energy->mechanical_residual), 1e-11);
  EXPECT_LE(outcome->laws->current_sum_A, 4 * 0x1p-52 * 24.0 / 0.515)
      << "a few roundings of the stall current";
  EXPECT_LE(outcome->laws->reverse_diode_A, 64 * 0x1p-52 * 24.0 / 0.515)
      << "the engine's noise level of a current";
  EXPECT_EQ(outcome->laws->floating_current_A, 0.0);
  // The run must report and name a broken line. A sensorless drive continues, unless its rotor is locked.
  const sixstep::study::HallBreak& broken = scenario->sensors.hall_break;
  const bool sensorless = scenario->control.drive == study::FirmwareKind::sensorless;
  EXPECT_EQ(outcome->fault.has_value(),
            misled || (sensorless ? scenario->load.locked : broken.at_s.has_value()));
  const auto named = std::count_if(outcome->notes.begin(), outcome->notes.end(), [](const std::string& note) {
    return !note.starts_with("figures measured after the trip");
  });
  if (sensorless)
    EXPECT_EQ(named, broken.at_s ? 1 : 0);
  else
    EXPECT_EQ(outcome->trip ? outcome->trip->hall_line : 0, broken.at_s ? broken.line : 0);
  for (const study::Verdict& v : outcome->verdicts)
    EXPECT_TRUE(v.ok) << v.figure << ": " << v.measured << " " << v.unit;
}

INSTANTIATE_TEST_SUITE_P(Data, EveryShippedRun, ::testing::ValuesIn(shipped_scenarios()),
                         [](const auto& scenario) {
                           std::string name = fs::path(scenario.param).stem().string();
                           for (char& c : name)
                             if (!std::isalnum(static_cast<unsigned char>(c))) c = '_';
                           return name;
                         });

}  // namespace SIXSTEP_TEST_FILE
}  // namespace text

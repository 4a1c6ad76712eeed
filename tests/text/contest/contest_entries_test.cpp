// SPDX-License-Identifier: Apache-2.0
// The comparison of controllers is fair. Their scenarios differ only in the keys of their rows, and no row
// contains a value that was tuned by hand.
#include "text/contest/contest_entries.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <regex>

#include "text/scenario/scenario_text.hpp"

namespace SIXSTEP_TEST_FILE {

using namespace sixstep;
using analysis::Contestant;
using analysis::ContestBench;
using analysis::ContestEntry;

ContestBench bench_of(const std::string& motor) {
  const auto sheet = text::read_sheet(motor);
  EXPECT_TRUE(sheet);
  auto bench = analysis::contest_bench({.motor = motor, .sheet = *sheet});
  EXPECT_TRUE(bench) << to_string(bench.problems().front());
  return *bench;
}

/// The keys whose values differ between two scenarios, except title, notes and spread.
std::vector<std::string> differences(const study::Scenario& a, const study::Scenario& b) {
  std::map<std::string, std::string> of_a, of_b;
  for (const text::WrittenValue& v : text::scenario_values(a)) of_a[v.path] = v.text;
  for (const text::WrittenValue& v : text::scenario_values(b)) of_b[v.path] = v.text;
  std::vector<std::string> out;
  const auto one_way = [&](const auto& from, const auto& to) {
    for (const auto& [path, value] : from) {
      const auto there = to.find(path);
      if (path == "title" || path == "notes" || path.starts_with("spread[")) continue;
      if (there == to.end() || there->second != value) out.push_back(path);
    }
  };
  one_way(of_a, of_b);
  one_way(of_b, of_a);
  return out;
}

/// Returns whether a path belongs to a row: it is a key of the row, or it is inside a table of the row.
bool is_of_row(const ContestEntry& entry, const std::string& path) {
  return std::any_of(entry.keys.begin(), entry.keys.end(), [&](const analysis::ContestKey& key) {
    return path == key.path || path.starts_with(key.path + ".");
  });
}

constexpr const char* motors[] = {"maxon-251601", "teknic-m2310p", "dji-2212-920kv"};

TEST(Contest, ScenariosDifferInTheKeysOfTheirRowsAlone) {
  for (const char* motor : motors) {
    const ContestBench bench = bench_of(motor);
    const auto entries = text::contest_entries(bench, {});
    ASSERT_EQ(entries.size(), analysis::contestants().size());
    for (const ContestEntry& entry : entries) {
      ASSERT_TRUE(entry.scenario) << entry.who->name << ": " << to_string(entry.scenario.problems().front());
      const auto different = differences(bench.scenario, *entry.scenario);
      for (const std::string& path : different)
        EXPECT_TRUE(is_of_row(entry, path)) << entry.who->name << ": " << path;
      EXPECT_EQ(different.empty(), entry.keys.empty()) << entry.who->name;
    }
  }
}

/// Sample, delay, limits, bus, bridge, sensors and course are the same for all controllers. The keys in this
/// list are the exceptions.
TEST(Contest, NoRowTouchesWhatIsTheSameForAll) {
  const std::map<std::string_view, std::string> exceptions = {
      {"hysteresis, comparators", "pwm.delay_periods"},  // nothing is sampled
      {"six-step, advanced", "sensors.hall_angle"},      // the product drive commutates by sectors
      {"speed to duty", "control.speed"},                // it has no torque that could be limited
      {"state feedback", "control.speed"},               // these three laws place real poles and use no
                                                         // damping
      {"disturbance rejection", "control.speed"},
      {"sliding mode", "control.speed"}};
  const ContestBench bench = bench_of("maxon-251601");
  const std::regex common(
      "motor.*|supply.*|bridge.*|pwm\\.(period_s|sample|alignment|delay_periods)|sensors.*|load.*|reference.*|"
      "initial.*|at.*|require.*|compare.*|duration_s|control\\.limits.*|control\\.speed|"
      "control\\.speed\\.(torque_limit_Nm|settle_s|damping|d0|d1|kp|ki)|"
      "control\\.current\\.(settle_s|damping|d0|d1|kp|ki|limit_A)");
  for (const Contestant& who : analysis::contestants()) {
    const auto keys = analysis::keys_of(who, bench);
    ASSERT_TRUE(keys) << who.name;
    for (const analysis::ContestKey& key : *keys) {
      const auto exception = exceptions.find(who.name);
      if (exception != exceptions.end() && exception->second == key.path) continue;
      EXPECT_FALSE(std::regex_match(key.path, common)) << who.name << ": " << key.path;
    }
  }
}

/// A number in a row would be a free choice. If a rule gives the value, the row contains <name> instead. The
/// 0 delay periods of the comparators are an exception.
TEST(Contest, NoRowHasANumber) {
  const std::regex number("[=,{] *-?[0-9.]");
  for (const Contestant& who : analysis::contestants()) {
    std::string keys(who.keys);
    if (const auto at = keys.find("pwm.delay_periods = 0"); at != std::string::npos) keys.erase(at);
    EXPECT_FALSE(std::regex_search(keys, number)) << who.name << ": " << keys;
  }
}

/// The speed loop and the current loop of the field-oriented drive have the same settling times and limits as
/// the loops of the other drives.
TEST(Contest, FieldOrientedHasTheSameLoopsAskedFor) {
  const ContestBench bench = bench_of("teknic-m2310p");
  for (const ContestEntry& entry : text::contest_entries(bench, {})) {
    if (entry.who->name != analysis::field_name) continue;
    EXPECT_EQ(entry.scenario->control.current.settle_s, bench.scenario.control.current.settle_s);
    EXPECT_EQ(entry.scenario->control.speed.settle_s, bench.scenario.control.speed.settle_s);
    EXPECT_EQ(entry.scenario->control.speed.torque_limit_Nm, bench.scenario.control.speed.torque_limit_Nm);
    EXPECT_TRUE(entry.scenario->control.speed.settle_s.has_value());
  }
}

TEST(Contest, WhatAMotorDoesNotAllowIsToldAndTheOthersStay) {
  const ContestBench bench = bench_of("maxon-251601");
  constexpr Contestant odd[] = {{"as it is", "", "is common"},
                                {"unruly", "pwm.period_s = <chosen>", "asks for what no rule finds"},
                                {"nameless", "pwm.perod_s = soft", "misspells a key"}};
  const auto entries = text::contest_entries(bench, {}, odd);
  ASSERT_EQ(entries.size(), 3U);
  EXPECT_TRUE(entries[0].scenario);
  ASSERT_FALSE(entries[1].scenario);
  EXPECT_EQ(entries[1].scenario.problems().front().value, "<chosen>");
  ASSERT_FALSE(entries[2].scenario);
  EXPECT_NE(to_string(entries[2].scenario.problems().front()).find("pwm.perod_s"), std::string::npos);
}

/// The scenarios differ on purpose. The comparison of the first test must find this difference.
TEST(Contest, APlantedDifferenceIsFound) {
  const ContestBench bench = bench_of("maxon-251601");
  study::Scenario other = bench.scenario;
  other.pwm.period_s *= 0.5;
  EXPECT_EQ(differences(bench.scenario, other).front(), "pwm.period_s");
}

}  // namespace SIXSTEP_TEST_FILE

// SPDX-License-Identifier: Apache-2.0
// Every described key in turn is set to numbers that occur on no bench. A message must refuse the number.
// Otherwise the run must end with only numbers in its results, and without an excessive number of steps.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <array>
#include <cmath>

#include "sixstep/base/plausible.hpp"
#include "sixstep/base/written.hpp"
#include "sixstep/design/loops/drive_design.hpp"
#include "sixstep/design/sheet/sheet_check.hpp"
#include "sixstep/plant/pace.hpp"
#include "sixstep/study/run/run.hpp"
#include "tests/support/in_part.hpp"
#include "text/keys/key_catalog.hpp"
#include "text/keys/key_tree.hpp"
#include "text/scenario/scenario_file.hpp"

namespace text {
namespace SIXSTEP_TEST_FILE {

/// Every list of tables in the scenario has one entry, and the bus has R and C, so that each key has an
/// effect.
const std::string common = R"(
motor = "maxon-251601"
duration_s = 0.0005
supply = { voltage_V = 24, resistance_ohm = 0.1, capacitance_F = 1e-3 }
bridge = { on_resistance_ohm = 0.01, diode_drop_V = 0.7, diode_resistance_ohm = 0.01, dead_time_s = 5e-7 }
initial = { speed_rad_s = 50, angle_rad = 0.1, bus_V = 24 }
load = { coulomb_Nm = 0.001, torque_Nm = 0.001 }
[[at]]
time_s = 0.0002
supply.voltage_V = 23
load.torque_Nm = 0.002
[[at]]
time_s = 0.0003
reference.value = 0.5
[[require]]
metric = "max"
signal = "current"
max = 1000
[[compare]]
metric = "settling_time_s"
signal = "current"
level = 1
start = 0
value = 1
source = "here"
[[spread]]
key = "supply.voltage_V"
relative = 0.01
)";

const std::string current_loop = common + R"(
[control]
mode = "current"
current = { settle_s = 1e-3, damping = 0.9 }
[reference]
value = 1
)";
const std::string hysteresis = common + R"(
[control]
mode = "current"
current = { type = "hysteresis", band_A = 0.2 }
[reference]
value = 1
)";
const std::string product = common + R"(
[control]
drive = "product"
mode = "speed"
current = { settle_s = 1e-3, damping = 0.9, limit_A = 5 }
speed = { form = "positional", settle_s = 0.05, damping = 0.9, derivative_s = 1e-3, derivative_filter_s = 1e-4 }
limits = { current_A = 6, speed_rad_s = 300 }
[sensors]
currents = "phases"
current_range_A = 20
bus = "adc"
bus_range_V = 50
rotor = "hall"
[protection]
over_current_A = 15
over_voltage_V = 40
under_voltage_V = 5
over_speed_rad_s = 600
align = { current_A = 1 }
[reference]
value = 100
)";
/// In the arithmetic of a chip, numbers overflow earlier, or they wrap.
const std::string speed_in_float = common + R"(
[control]
mode = "speed"
arithmetic = "float"
[reference]
value = 100
)";
const std::string position_in_q31 = common + R"(
[control]
mode = "position"
arithmetic = "q31"
[reference]
value = 10
)";
const std::string off = common + "[control]\nmode = \"off\"\n";

/// A run is stopped after this number of segments. By then, its time must have advanced.
constexpr std::int64_t most_segments = 20'000;

/// Bound on the number of segments. It allows two per shortest time constant, of which a few may be adjacent,
/// some per PWM period and tick, and some at the start of any run.
double most_segments_in(double simulated_s, const study::Scenario& s) {
  return 1000 + simulated_s * (20 * sixstep::plant::fastest_answer_1_s + 20 / s.pwm.period_s);
}

void expect_told(const base::Problems& problems) {
  for (const base::Problem& p : problems) {
    EXPECT_FALSE(p.where.empty());
    EXPECT_FALSE(p.limit.empty());
    EXPECT_EQ(to_string(p).find("defect"), std::string::npos) << to_string(p);
    EXPECT_LT(to_string(p).size(), 3000u);
  }
}

void expect_sound_run(const study::Scenario& s) {
  std::int64_t calls = 0, rows = 0, broken = 0;
  const auto outcome = study::run(s, {.on_record =
                                          [&](study::Row row) {
                                            ++rows;
                                            for (const double x : row) broken += !std::isfinite(x);
                                          },
                                      .on_event = {},
                                      .on_logic = {},
                                      .keep_going =
                                          [&](double t_s) {
                                            EXPECT_TRUE(std::isfinite(t_s));
                                            return ++calls * 256 < most_segments && rows < most_segments;
                                          }});
  if (!outcome) return expect_told(outcome.problems());
  EXPECT_EQ(broken, 0);
  EXPECT_TRUE(std::isfinite(outcome->simulated_s));
  EXPECT_LE(static_cast<double>(outcome->segments), most_segments_in(outcome->simulated_s, s)) << "crawls";
  for (const study::Verdict& v : outcome->verdicts)
    EXPECT_TRUE(!v.ok || std::isfinite(v.measured)) << v.figure;
}

void expect_refused_or_sound(const std::string& text, const Setting& setting) {
  SCOPED_TRACE(setting.path + " = " + setting.text);
  const auto scenario = read_scenario_text("x.toml", text, {.overrides = {setting}, .resolve = {}});
  if (!scenario) return expect_told(scenario.problems());
  expect_sound_run(*scenario);
}

/// The path of a key in the first entry of its list: "require[0].max" for "require.max".
std::string path_in_file(const KeyEntry& entry) {
  for (const std::string_view list : {"at", "require", "compare", "spread"})
    if (entry.path.starts_with(std::string(list) + "."))
      return fmt::format("{}[0]{}", list, entry.path.substr(list.size()));
  return entry.path;
}

std::string in_key(const KeyEntry& entry, const std::string& number) {
  if (entry.type == KeyType::numbers) return fmt::format("[0, {}]", number);
  const std::vector<std::string> frames = frames_of(entry.about.frame);
  if (entry.type == KeyType::quantity && frames.size() > 1)
    return fmt::format("{{ value = {}, frame = \"{}\" }}", number, frames.front());
  return number;
}

bool is_number(const KeyEntry& entry) {
  return entry.type == KeyType::number || entry.type == KeyType::whole_number ||
         entry.type == KeyType::numbers || entry.type == KeyType::quantity;
}

/// The ends of the key's allowed range, as text.
std::vector<std::string> ends_of(const KeyEntry& entry) {
  const base::Range range = base::allowed(entry.about);
  std::vector<std::string> ends;
  for (const double end : {range.low, range.high, range.least, -range.least})
    ends.push_back(entry.type == KeyType::whole_number ? fmt::format("{:.0f}", end) : base::written(end));
  return ends;
}

constexpr std::array hostile = {"nan",
                                "inf",
                                "-inf",
                                "1e308",
                                "-1e308",
                                "5e-324",
                                "-5e-324",
                                "0",
                                "-0.0",
                                "1e-300",
                                "1e15",
                                "-1e15",
                                "1e-15",
                                "2147483647",
                                "-2147483648",
                                "9223372036854775807",
                                "-9223372036854775808"};

std::vector<KeyEntry> keys_of_scenarios_and_motors() {
  std::vector<KeyEntry> keys;
  for (const KeyEntry& key : scenario_keys())
    if (is_number(key)) keys.push_back(key);
  return keys;
}

TEST(HostileNumbers, EveryKeyRefusesThemOrRunsToNumbers) {
  const std::vector<KeyEntry> keys = keys_of_scenarios_and_motors();
  ASSERT_GT(keys.size(), 150u);  // including the keys of motor_override
  const auto expect = [](const std::string& text, const KeyEntry& key, const std::string& number) {
    expect_refused_or_sound(text, {path_in_file(key), in_key(key, number)});
  };
  const std::array<const std::string*, 4> drives{&current_loop, &product, &speed_in_float, &position_in_q31};
  for (std::size_t k = 0; k < keys.size(); ++k)
    for (std::size_t d = 0; d < drives.size(); ++d) {
      // Each key is tested in one drive of each kind, and in every drive if all cases run.
      if (!sixstep::testing::all_cases() && d != k % 2 && d != 2 + k % 2) continue;
      if (d < 2)
        for (const char* number : hostile) expect(*drives[d], keys[k], number);
      for (const std::string& number : ends_of(keys[k])) expect(*drives[d], keys[k], number);
    }
}

TEST(HostileNumbers, EveryUnitThatAKeyHasIsInTheTable) {
  for (const std::vector<KeyEntry>& keys : {scenario_keys(), sheet_keys()})
    for (const KeyEntry& key : keys)
      if (is_number(key)) {
        EXPECT_EQ(base::plausible(key.about.unit).unit, key.about.unit) << key.path;
      }
}

TEST(HostileNumbers, NoKeyTakesWhatIsNoNumberOrOverflows) {
  for (const KeyEntry& key : keys_of_scenarios_and_motors())
    for (const char* number : {"nan", "inf", "-inf", "1e308", "-1e308", "5e-324"}) {
      const auto scenario = read_scenario_text(
          "x.toml", current_loop, {.overrides = {{path_in_file(key), in_key(key, number)}}, .resolve = {}});
      EXPECT_FALSE(scenario) << key.path << " = " << number;
    }
}

TEST(HostileNumbers, AMotorAtTheEndsOfItsKeysIsCheckedAndDesignedForInNumbers) {
  std::size_t checked = 0;
  for (const KeyEntry& key : sheet_keys()) {
    if (!is_number(key)) continue;
    for (const std::string& number : ends_of(key)) {
      const std::string path = "motor_override." + key.path;
      SCOPED_TRACE(path + " = " + number);
      const auto scenario = read_scenario_text("x.toml", current_loop,
                                               {.overrides = {{path, in_key(key, number)}}, .resolve = {}});
      if (!scenario) {
        expect_told(scenario.problems());
        continue;
      }
      ++checked;
      const auto sheet = design::check_sheet(scenario->sheet);
      for (const design::Relation& r : sheet ? sheet->relations : std::vector<design::Relation>())
        EXPECT_TRUE(std::isfinite(r.left) && std::isfinite(r.right) && std::isfinite(r.deviation)) << r.name;
      const auto motor = design::motor_model(scenario->sheet);
      ASSERT_TRUE(motor);
      const auto drive =
          design::design_drive(*motor, {.mode = sixstep::control::Mode::speed, .voltage_V = 24});
      if (!drive) {
        expect_told(drive.problems());
        continue;
      }
      for (const design::LoopDesign& loop : drive->loops)
        EXPECT_TRUE(std::isfinite(loop.gains.d1) && std::isfinite(loop.gains.d0)) << loop.name;
    }
  }
  EXPECT_GT(checked, 50u);
}

/// Two keys are at the ends of their ranges. Values that are allowed separately can be absurd together.
TEST(HostileNumbers, PairsOfExtremesAreRefusedOrRunToNumbers) {
  std::vector<Setting> ends;
  for (const KeyEntry& key : scenario_keys()) {
    const bool plant =
        key.path.starts_with("supply.") || key.path.starts_with("bridge.") || key.path.starts_with("load.") ||
        key.path.starts_with("initial.") || key.path.starts_with("pwm.") ||
        key.path == "motor_override.resistance_ohm" || key.path == "motor_override.inductance_mH" ||
        key.path == "motor_override.inertia_gcm2" || key.path == "motor_override.torque_constant_mNm_A";
    if (!plant || !is_number(key) || key.type == KeyType::numbers) continue;
    const base::Range range = base::allowed(key.about);
    for (const double end : {range.low, range.high, range.least})
      if (range.holds(end))
        ends.push_back({key.path, in_key(key, key.type == KeyType::whole_number ? fmt::format("{:.0f}", end)
                                                                                : base::written(end))});
  }
  ASSERT_GT(ends.size(), 50u);
  for (std::size_t a = 0; a < ends.size(); ++a)
    for (std::size_t b = a + 1; b < ends.size(); ++b) {
      if (ends[a].path == ends[b].path || (!sixstep::testing::all_cases() && (5 * a + b) % 4 != 0)) continue;
      SCOPED_TRACE(ends[a].path + " = " + ends[a].text);
      const std::string* text = (a + b) % 3 == 0 ? &off : (a + b) % 3 == 1 ? &hysteresis : &current_loop;
      SCOPED_TRACE(ends[b].path + " = " + ends[b].text);
      const auto scenario =
          read_scenario_text("x.toml", *text, {.overrides = {ends[a], ends[b]}, .resolve = {}});
      if (!scenario)
        expect_told(scenario.problems());
      else
        expect_sound_run(*scenario);
    }
}

}  // namespace SIXSTEP_TEST_FILE
}  // namespace text

// SPDX-License-Identifier: Apache-2.0
// Tests hostile files: numbers that overflow, and text that nests or repeats without end. Each file must
// cause a message of readable length. The number of steps must be proportional to the length of the file.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include "sixstep/study/run/run.hpp"
#include "text/scenario/reference_file.hpp"
#include "text/scenario/scenario_file.hpp"

namespace text {
namespace SIXSTEP_TEST_FILE {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::SizeIs;

const std::string head = "motor = \"maxon-251601\"\nduration_s = 0.001\n";

std::vector<std::string> told(const std::string& text, const std::vector<Setting>& settings = {}) {
  const auto scenario = read_scenario_text("x.toml", text, {.overrides = settings, .resolve = {}});
  std::vector<std::string> lines;
  if (!scenario)
    for (const base::Problem& p : scenario.problems()) lines.push_back(to_string(p));
  return lines;
}

TEST(HostileInput, AResistanceThatUnderflowsIsRefused) {
  EXPECT_THAT(told(head + "[motor_override]\nline_10_terminal_resistance_ohm = 5e-324\n"),
              ElementsAre(HasSubstr("x.toml:4:35: motor_override.line_10_terminal_resistance_ohm = 5e-324 "
                                    "must be at least 1e-06")));
}

TEST(HostileInput, ASpeedThatOverflowsIsRefused) {
  EXPECT_THAT(
      told(head + "[initial]\nspeed_rad_s = 1.7976931348623157e+308\n"),
      ElementsAre("x.toml:4:15: initial.speed_rad_s = 1.7976931348623157e+308 must lie in -1000000 to "
                  "1000000; it means: mechanical speed at the start, in rad/s"));
}

TEST(HostileInput, ABusFasterThanAnyBoardIsRefusedWithItsTimeConstant) {
  const std::string bus = "[supply]\nresistance_ohm = 0.2\ncapacitance_F = 1e-7\n";
  EXPECT_THAT(
      told(head + bus),
      ElementsAre(
          "x.toml:5:17: supply.capacitance_F = 1e-07 gives the bus, with supply.resistance_ohm = 0.2 and the winding, a time constant of 14.4 ns, and no board has less than 100 ns; correct the unit of this value: a bus has hundreds of microfarads; for a stiff bus remove resistance and capacitance"));
  EXPECT_THAT(told(head + "[supply]\nresistance_ohm = 0.2\ncapacitance_F = 1e-5\n"), SizeIs(0));
  EXPECT_THAT(told(head + "[initial]\nbus_V = 1e308\n[supply]\nresistance_ohm = 0.2\ncapacitance_F = 1e-3\n"),
              ElementsAre(HasSubstr("initial.bus_V = 1e308 must be above 0 and at most 100000")));
}

TEST(HostileInput, ABatteryThatRecoversAtOnceIsRefused) {
  const auto battery = [](const char* farad) {
    return told(
        head +
        "[supply]\nsource = \"battery\"\nvoltage_V = 24\nresistance_ohm = 0.08\ncapacitance_F = 470e-6\n"
        "battery_charges = [0, 1]\nbattery_voltages_V = [24, 24]\nbattery_capacity_Ah = 2\n"
        "battery_recovery_ohm = 0.05\nbattery_recovery_F = " +
        farad + "\n");
  };
  EXPECT_THAT(battery("1e-6"),
              ElementsAre(HasSubstr("supply.battery_recovery_F = 1e-06 gives the battery's recovery, with "
                                    "supply.battery_recovery_ohm = 0.05, a time constant of 30.8 ns")));
  EXPECT_THAT(battery("4e-6"), SizeIs(0));
}

TEST(HostileInput, SpeedsOfALoadThatNobodyTellsApartAreRefused) {
  const auto table = [](const char* speed) {
    return told(head + "[load]\nat_speeds_rad_s = [" + speed + ", 0, 300]\nat_speeds_Nm = [0.1, 0, 0.1]\n");
  };
  EXPECT_THAT(table("-1e-17"),
              ElementsAre(HasSubstr("load.at_speeds_rad_s = 0 is too close to the previous speed")));
  EXPECT_THAT(table("1"),
              ElementsAre(HasSubstr("load.at_speeds_rad_s = 0 must be above the previous speed")));
  EXPECT_THAT(table("-1e-5"), SizeIs(0));
}

TEST(HostileInput, MagnetsThatAreGoneAtTheStartAreRefusedAndLaterOnNoDefect) {
  const auto motor = [](const char* degC) {
    return head + "motor_override.magnet_loss_percent_K = 1\n[heat]\nmotor = true\nambient_degC = " + degC +
           "\n";
  };
  EXPECT_THAT(told(motor("125")),
              ElementsAre(HasSubstr("heat.ambient_degC = 125 leaves the magnets at most a tenth")));
  EXPECT_THAT(told(motor("50") + "housing_degC = 116\n"),
              ElementsAre(HasSubstr("heat.housing_degC = 116 leaves")));
  // The housing warms up beyond the limit. The magnets then keep a tenth of their flux linkage.
  const auto scenario = read_scenario_text(
      "x.toml",
      "motor = \"maxon-251601\"\nduration_s = 4\nmotor_override.magnet_loss_percent_K = 1\n"
      "[heat]\nmotor = true\nambient_degC = 114\nwinding_degC = 900\n"
      "[[require]]\nmetric = \"final\"\nsignal = \"housing_degC\"\nmin = 125.5\n",
      {.overrides = {}, .resolve = {}});
  ASSERT_TRUE(scenario) << to_string(scenario.problems()[0]);
  const auto outcome = study::run(*scenario);
  ASSERT_TRUE(outcome) << to_string(outcome.problems()[0]);
  EXPECT_TRUE(outcome->passed());
  EXPECT_FALSE(outcome->fault);
}

TEST(HostileInput, ASwitchOfMegohmsIsRefused) {
  EXPECT_THAT(told(head + "[bridge]\non_resistance_ohm = 1e9\n"),
              ElementsAre(HasSubstr("bridge.on_resistance_ohm = 1e9 must lie in 0 to 1000000")));
  EXPECT_THAT(told(head + "[bridge]\non_resistance_ohm = 1e5\n"),
              ElementsAre(HasSubstr("gives winding and bridge a time constant of 2.86 ns")));
}

TEST(HostileInput, AFrictionThatStopsTheRotorAtOnceIsRefused) {
  EXPECT_THAT(told(head + "[load]\nviscous_Nm_s = 1000\n"),
              ElementsAre(HasSubstr("stops the rotor within 13.5 ns")));
}

TEST(HostileInput, ABandThatNoBridgeFollowsIsRefusedAndIsNoDefect) {
  const auto band = [](const char* band_A) {
    return told(head + "[control]\nmode = \"current\"\ncurrent = { type = \"hysteresis\", band_A = " +
                band_A + " }\n[reference]\nvalue = 5\n");
  };
  EXPECT_THAT(band("1e-15"), ElementsAre(HasSubstr("control.current.band_A = 1e-15 must be at least 1e-09")));
  EXPECT_THAT(band("1e-6"), ElementsAre(HasSubstr("widen this value to at least 0.0021 A")));
  EXPECT_THAT(band("0.0022"), SizeIs(0));
}

TEST(HostileInput, ReferencesBeyondAnyMotorAreRefused) {
  const std::string mode = "[control]\nmode = \"current\"\n[reference]\n";
  EXPECT_THAT(told(head + mode + "value = 1e308\n"),
              ElementsAre(HasSubstr("reference.value = 1e308 must lie in")));
  EXPECT_THAT(told(head + mode + "value = 2e6\n"),
              ElementsAre(HasSubstr("reference.value = 2e+06 must lie in -1000000 to 1000000")));
  EXPECT_THAT(told(head + mode + "shape = \"csv\"\ntimes_s = [0, 1e-4]\nvalues = [1, -1e308]\n"),
              ElementsAre(HasSubstr("x.toml:8:14: reference.values = -1e308 must lie in")));
}

TEST(HostileInput, ATorqueWithoutMeasureIsRefused) {
  EXPECT_THAT(
      told(head + "[load]\ntorque_Nm = 1e6\n"),
      ElementsAre(HasSubstr("load.torque_Nm = 1e+06 is too large for a moment of inertia of 1.35e-05 kg m2: "
                            "at most 1.69e+04 N m are simulated")));
  EXPECT_THAT(told(head + "[[at]]\ntime_s = 1e-4\nload.torque_Nm = 1e6\n"), SizeIs(1));
  EXPECT_THAT(told(head + "[load]\ntimes_s = [0, 1e-4]\ntorques_Nm = [0, 1e6]\n"), SizeIs(1));
}

/// Each number is allowed, but all numbers together accelerate the rotor beyond all bounds.
TEST(HostileInput, ARunThatRunsAwayEndsWithAFaultAndWritesNumbersOnly) {
  const auto scenario = read_scenario_text(
      "x.toml",
      head + "[load]\ntorque_Nm = -1e4\n[[require]]\nmetric = \"max\"\nsignal = \"current\"\nmax = 1e9\n");
  ASSERT_TRUE(scenario);
  bool numbers = true;
  const auto outcome = study::run(*scenario, {.on_record = [&](study::Row row) {
    for (const double x : row) numbers = numbers && x - x == 0.0;
  }});
  ASSERT_TRUE(outcome);
  ASSERT_TRUE(outcome->fault);
  EXPECT_THAT(to_string(*outcome->fault), HasSubstr("the run diverged: the speed is"));
  EXPECT_FALSE(outcome->passed());
  EXPECT_TRUE(numbers);
}

TEST(HostileInput, AColumnThatTheModeDoesNotHaveIsRefusedAndNotWrittenAsNoNumber) {
  const std::string columns = "record.columns = [\"i_m_A\", \"i_ref_A\"]\n[control]\nmode = ";
  EXPECT_THAT(
      told(head + columns + "\"duty\"\n"),
      ElementsAre(
          "x.toml:3:18: record.columns = \"i_ref_A\" has no value in this control.mode; remove this column, "
          "or set a control.mode that has this reference"));
  EXPECT_THAT(told(head + columns + "\"current\"\n"), SizeIs(0));
}

std::string repeated(const std::string& text, std::size_t times) {
  std::string all;
  all.reserve(text.size() * times);
  for (std::size_t n = 0; n < times; ++n) all += text;
  return all;
}

TEST(HostileInput, AKeyOfAHundredThousandPartsDoesNotTakeTheStack) {
  EXPECT_THAT(
      told(head + repeated("a.", 100'000) + "b = 1\n"),
      ElementsAre(
          "x.toml:3:66: nests deeper than 32 tables or lists; remove levels: the deepest keys have three parts, as control.current.settle_s"));
  EXPECT_THAT(told(head + "[" + repeated("a.", 100'000) + "b]\n"), ElementsAre(HasSubstr("nests deeper")));
  EXPECT_THAT(told(head + "a = " + repeated("[", 100'000)), ElementsAre(HasSubstr("nests deeper")));
  EXPECT_THAT(told(head + "a = " + repeated("{a = ", 100'000)), ElementsAre(HasSubstr("nests deeper")));
  EXPECT_THAT(told(head, {{repeated("a.", 100'000) + "b", "1"}}), ElementsAre(HasSubstr("nests too deep")));
  EXPECT_THAT(told(head, {{"a", "{" + repeated("a.", 100'000) + "b = 1}"}}),
              ElementsAre(HasSubstr("nests too deep")));
}

TEST(HostileInput, DotsAndBracketsInWordsAndRemarksNestNothing) {
  const std::string dots = repeated(".[{", 100);
  EXPECT_THAT(told("title = \"" + dots + "\\\"" + dots + "\"\n" + head), SizeIs(0));
  EXPECT_THAT(told("title = '" + dots + "'\n" + head), SizeIs(0));
  EXPECT_THAT(told("title = \"\"\"" + dots + "\n\" \"\" " + dots + "\"\"\"\n" + head), SizeIs(0));
  EXPECT_THAT(told("title = '''" + dots + "\n'' " + dots + "'''\n" + head), SizeIs(0));
  EXPECT_THAT(told("# " + dots + "\n" + head), SizeIs(0));
}

TEST(HostileInput, OfAListOfWrongEntriesSomeAreTold) {
  const std::string list =
      "[reference]\nshape = \"steps\"\ntimes_s = [" + repeated("true,\n", 100'000) + "]\n";
  EXPECT_THAT(told(head + list), SizeIs(6));
  const std::string words = "[record]\ncolumns = [" + repeated("1,", 100'000) + "]\n";
  EXPECT_THAT(told(head + words), SizeIs(6));
  const std::string ones = "[" + repeated("1,", 100'000) + "]\n";
  EXPECT_THAT(told(head + "[reference]\nshape = \"steps\"\ntimes_s = " + ones + "values = " + ones),
              SizeIs(5));
}

TEST(HostileInput, OfAHundredThousandMistakesAHundredAreTold) {
  std::string keys;
  for (int n = 0; n < 100'000; ++n) keys += fmt::format("nonsense_{} = 1\n", n);
  const std::vector<std::string> lines = told(head + keys);
  ASSERT_THAT(lines, SizeIs(101));
  EXPECT_EQ(lines.back(), "x.toml: is wrong in 99900 more places; correct the errors above first");
  EXPECT_THAT(told(head + repeated("[[require]]\nmetric = 1\n", 20'000)),
              ElementsAre(HasSubstr("has 20000 tables; at most 10000 are allowed")));
}

TEST(HostileInput, MessagesAboutLongTextStayShort) {
  const std::string long_word(10'000'000, 'x'), digits(10'000'000, '7');
  const std::vector<std::string> files = {
      head + long_word + " = 1\n",
      head + "[supply]\nvoltage_V = \"" + digits + " V\"\n",
      head + "[supply]\nvoltage_V = \"1 " + long_word + "\"\n",
      head + "[control]\nmode = \"" + long_word + "\"\n",
      head + "[supply]\nvoltage_V = 0." + digits + "\n",
      head + "[[require]]\nmetric = \"max\"\nmax = 1\nlabel = 1\nsignal = \"" + long_word + "\"\n",
      "motor = \"" + long_word + "\"\nduration_s = 1\n",
  };
  for (const std::string& file : files) {
    const std::vector<std::string> lines = told(file);
    EXPECT_FALSE(lines.empty());
    for (const std::string& line : lines) EXPECT_LT(line.size(), 2500u) << line.substr(0, 200);
  }
}

std::vector<std::string> told_of_rows(const std::string& rows) {
  const auto read = reference_rows("r.csv", rows, {}, "A");
  std::vector<std::string> lines;
  if (!read)
    for (const base::Problem& p : read.problems()) lines.push_back(to_string(p));
  return lines;
}

TEST(HostileInput, ATableOfRowsIsHeldToTheSameNumbers) {
  EXPECT_THAT(
      told_of_rows("t_s,i_A\n0,1\n1e-3,1e308\n"),
      ElementsAre(
          "r.csv:3: value 1e+308 must lie in -1000000 to 1000000, in A; check the unit of this column"));
  EXPECT_THAT(told_of_rows("0,1\n1e10,2\n"),
              ElementsAre(HasSubstr("time 10000000000 must lie in -9000000 to 9000000, in s")));
  for (const char* none : {"nan", "inf", "-inf", "1e999"})
    EXPECT_THAT(told_of_rows(std::string("0,1\n1,") + none + "\n"), ElementsAre(HasSubstr("is not a number")))
        << none;
}

TEST(HostileInput, ARecordedTraceThatFadesIsZeroInTheEnd) {
  const auto rows = reference_rows("r.csv", "0,1\n1e-3,-3e-312\n", {}, "A");
  ASSERT_TRUE(rows);
  EXPECT_EQ(rows->values, (std::vector<double>{1.0, 0.0}));
}

TEST(HostileInput, CellsOfTenMillionDigitsAreReadOrToldInAFewWords) {
  const std::string digits(10'000'000, '1');
  const auto rows = reference_rows("r.csv", "0,1." + digits + "\n", {}, "A");
  ASSERT_TRUE(rows);
  EXPECT_NEAR(rows->values.at(0), 10.0 / 9, 1e-15);
  const std::vector<std::string> lines = told_of_rows("0," + digits + "\n");
  ASSERT_THAT(lines, SizeIs(1));
  EXPECT_LT(lines[0].size(), 2500u);
  EXPECT_THAT(told_of_rows("0,1" + std::string(10'000'000, ';') + "\n"), SizeIs(1));
  EXPECT_THAT(told_of_rows(std::string(10'000'000, 'a') + "\n"), SizeIs(1));
}

}  // namespace SIXSTEP_TEST_FILE
/// A gear with losses drives a heavy load. When the torque of the gear reverses, its value is rounding noise.
/// An earlier version of the program used the sign of this noise as the sign of the torque.
TEST(HostileInput, AGearsTorqueThatTurnsRoundHasOneSign) {
  const auto scenario = read_scenario_text("x.toml", R"(motor = "maxon-397172"
duration_s = 0.010190500697991007
[pwm]
period_s = 0.0002761117792141052
[control]
mode = "speed"
[sensors]
rotor = "hall"
hall_edges_deg = [3.3446793375594464, -6.818504808132996, 6.450777031740346, -7.180292803434318, 1.8339898491658673, 7.339088953469757]
[load]
inertia_kg_m2 = 0.0003558900200905956
gear = 0.743253880498782
gear_efficiency = 0.41402657283327654
[initial]
speed_rad_s = -372.60553875793
)",
                                           {.overrides = {}, .resolve = {}});
  ASSERT_TRUE(scenario) << to_string(scenario.problems()[0]);
  const auto outcome = study::run(*scenario);
  EXPECT_TRUE(outcome) << to_string(outcome.problems()[0]);
}

/// Two currents are at the noise limit, and the third current is at twice this limit. One of the small
/// currents becomes zero. The balance reduces the large current to the noise limit, and then this current
/// becomes zero too. In an earlier version, it remained in a diode that no mode allows.
TEST(HostileInput, CurrentsThatBalancingBringsToTheNoiseAreZero) {
  const auto scenario = read_scenario_text("x.toml", R"(title = "drawn"
motor = "maxon-488607"
duration_s = 0.15245299297354073

[supply]
voltage_V = 42.621247246624925
resistance_ohm = 0.005244680290205802
capacitance_F = 0.3742704240544477
sinks = false

[bridge]
dead_time_s = 1.272907669941043e-05

[pwm]
period_s = 0.0004450754107405259
alignment = "centre"
chopping = "complementary"

[control]
drive = "product"
mode = "current"
arithmetic = "q15"

[control.current]
kp = 1.226576482958033
ki = 0.4089179279515821

[sensors]
currents = "phases"
adc_bits = 8
current_range_A = 21.04834773989199
current_offset_A = 0.2060971029173483
current_noise_A = 0.004301555225281082
shunt_settle_s = 4.821772952771076e-06
bus = "adc"
bus_range_V = 106.21760330851212
rotor = "hall"
capture_Hz = 71432.11005162136
speed_edges = 2
timeout_s = 0.006492255042322115
seed = 547

[protection]
over_current_A = 17.744763026670924
over_voltage_V = 63.931870869937384
under_voltage_V = 21.532460545660925
over_speed_rad_s = 378.6255750016287
voltage_samples = 6
brake_current_A = 0.8893227176589533
off_at_s = 0.1417558859068423

[protection.align]
current_A = 1.0679936
)",
                                           {.resolve = {}});
  ASSERT_TRUE(scenario);
  const auto outcome = study::run(*scenario);
  EXPECT_TRUE(outcome) << to_string(outcome.problems()[0]);
}

}  // namespace text

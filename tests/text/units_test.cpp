// SPDX-License-Identifier: Apache-2.0
// A number in quotes with its own unit gives the same double as the decimal in the unit of the key.
#include "text/keys/units.hpp"

#include <gmock/gmock.h>

#include "sixstep/base/angle.hpp"
#include "text/keys/key_catalog.hpp"
#include "text/scenario/scenario_file.hpp"

namespace text {
namespace SIXSTEP_TEST_FILE {

double value(const std::string& written, const std::string& wanted) {
  const base::Result<double> x = in_unit(written, wanted);
  if (!x) ADD_FAILURE() << written << " in " << wanted << ": " << to_string(x.problems()[0]);
  return x ? *x : 0.0;
}

std::string refused(const std::string& written, const std::string& wanted) {
  const base::Result<double> x = in_unit(written, wanted);
  return x ? "accepted" : to_string(x.problems()[0]);
}

TEST(Units, PowersOfTenCostNoRounding) {
  EXPECT_EQ(value("20 ms", "s"), 0.02);
  EXPECT_EQ(value("30us", "s"), 30e-6);
  EXPECT_EQ(value("30 µs", "s"), 30e-6);
  EXPECT_EQ(value("0.572 mH", "H"), 0.000572);
  EXPECT_EQ(value("135 gcm2", "kg m2"), 1.35e-5);
  EXPECT_EQ(value("135 g cm^2", "kg m2"), 1.35e-5);
  EXPECT_EQ(value("135 g·cm²", "kg m2"), 1.35e-5);
  EXPECT_EQ(value("0.0135 kg*mm2", "g cm2"), 0.135);
  EXPECT_EQ(value("780 mNm", "N m"), 0.78);
  EXPECT_EQ(value("78 Ncm", "N m"), 0.78);
  EXPECT_EQ(value("33.5 mNm/A", "Nm/A"), 0.0335);
  EXPECT_EQ(value("1030 mΩ", "ohm"), 1.03);
  EXPECT_EQ(value("2.2e3 uF", "F"), 0.0022);
  EXPECT_EQ(value("1e-3 ms", "s"), 1e-6);
  EXPECT_EQ(value("2 %", ""), 0.02);
  EXPECT_EQ(value("85.5 percent", "percent"), 85.5);
  EXPECT_EQ(value("-.5 kV", "V"), -500.0);
  EXPECT_EQ(value("+5 A", "A"), 5.0);
  // The text has more digits than a double. It is rounded only once.
  EXPECT_EQ(value("0.123456789012345678901234567890 ms", "s"), 0.000123456789012345678901234567890);
}

TEST(Units, OtherFactorsAreRoundedLast) {
  // The factor and the product are each rounded once.
  EXPECT_DOUBLE_EQ(value("6710 rpm", "rad/s"), 6710 * 2 * M_PI / 60);
  EXPECT_DOUBLE_EQ(value("6710 1/min", "rad/s"), 6710 * 2 * M_PI / 60);
  EXPECT_DOUBLE_EQ(value("6710 min⁻¹", "rad/s"), 6710 * 2 * M_PI / 60);
  EXPECT_DOUBLE_EQ(value("6.71 krpm", "rad/s"), 6710 * 2 * M_PI / 60);
  EXPECT_DOUBLE_EQ(value("702.6 rad/s", "rpm"), 702.6 * 30 / M_PI);
  EXPECT_EQ(value("6710 rpm", "rpm"), 6710.0);
  EXPECT_DOUBLE_EQ(value("1 rev", "deg"), 360.0);
  EXPECT_EQ(value("2 min", "s"), 120.0);
  EXPECT_DOUBLE_EQ(value("1000 rpm/s", "rad/s2"), 1000 * M_PI / 30);
  EXPECT_DOUBLE_EQ(value("0.1 mNm/(rad/s)", "N m s"), 1e-4) << "an angle is a number where torque is";
  EXPECT_DOUBLE_EQ(value("3.508 V/krpm", "mV s"), 3.508 * 30 / M_PI);
}

TEST(Units, AFrequencyForAPeriodIsToldAsItsReciprocal) {
  EXPECT_EQ(
      refused("20 kHz", "s"),
      "has the unit kHz, and this key is a time; write the period, 1 over the frequency: 20 kHz is 50 us. Units that fit: s, ms, us or min");
}

TEST(Units, AWrongOneIsToldWithThoseThatFit) {
  EXPECT_EQ(refused("20 mA", "s"),
            "has the unit mA, which cannot be converted to s; units that fit: s, ms, us or min");
  EXPECT_EQ(
      refused("50 Hz", "rad/s"),
      "has the unit Hz, which may count turns of the shaft or electrical turns; write rev/s for turns of the shaft, or erpm, 60 times the electrical hertz; units that fit: rad/s, rpm, rev/s or deg/s");
  EXPECT_EQ(refused("20 msecs", "s"), "has the unknown unit msecs; units that fit: s, ms, us or min");
  EXPECT_EQ(refused("20 MS", "s"),
            "has the unknown unit MS; did you mean ms? Units that fit: s, ms, us or min");
  EXPECT_EQ(refused("20", "s"), "lacks its unit; write 20, which is in s, or \"20 s\"");
  EXPECT_EQ(refused("20", ""), "must be a number without quotes; write 20");
  EXPECT_EQ(
      refused("20 ms", ""),
      "has the unit ms, and this key takes a number without a unit; write the number without a unit, or with %");
  EXPECT_EQ(refused("0,5 A", "A"), "has a decimal comma; write a point, not a comma, as the decimal mark");
  EXPECT_EQ(refused("1e400 A", "A"),
            "is outside the range of a double, 4.9e-324 to 1.8e308; correct its exponent");
  EXPECT_EQ(refused("1e99999999999 A", "A"),
            "is outside the range of a double, 4.9e-324 to 1.8e308; correct its exponent");
  for (const char* no_number : {"a lot", "", " ", "nan A", "-inf A", "A", "--5 A", "e5 A"})
    EXPECT_THAT(refused(no_number, "A"), ::testing::HasSubstr("must be a number, in A")) << no_number;
  for (const char* no_unit :
       {"(", ")", "A)", "(A", "A//s", "/A", "A/", "((((((A))))))", "A-", "A0", "2", "*"})
    EXPECT_NE(refused("1 " + std::string(no_unit), "A"), "accepted") << no_unit;
}

TEST(Units, EveryKeysOwnUnitIsInTheTable) {
  std::vector<KeyEntry> keys = scenario_keys();
  const std::vector<KeyEntry>& sheet = sheet_keys();
  keys.insert(keys.end(), sheet.begin(), sheet.end());
  for (const KeyEntry& key : keys) {
    EXPECT_TRUE(unit_of(key.about.unit)) << key.path << " in " << key.about.unit;
    for (const base::Spelling& spelling : key.about.also)
      EXPECT_TRUE(unit_of(spelling.unit)) << spelling.key << " in " << spelling.unit;
    EXPECT_EQ(units_that_fit(key.about.unit).empty(), key.about.unit.empty()) << key.path;
  }
}

base::Result<study::Scenario> with(const std::string& keys, const ReadOptions& options = {}) {
  return read_scenario_text("x.toml", "motor = \"maxon-251601\"\n" + keys, options);
}

std::string told(const std::string& keys) {
  const base::Result<study::Scenario> s = with(keys);
  return s ? "accepted" : to_string(s.problems().at(0));
}

TEST(Units, AreTakenWhereverAKeyHasOne) {
  const auto s = with(R"(duration_s = "20 ms"
motor_override.resistance_ohm = { value = "980 mohm", frame = "terminal" }
motor_override.inertia_gcm2 = "1.4e-5 kgm2"
[control]
mode = "speed"
slew = "3000 rpm/s"
current.damping = "90 %"
[reference]
shape = "steps"
times_s = [0, "5 ms"]
values = ["955 rpm", 50]
[load]
inertia_kg_m2 = "135 gcm2"
)",
                      {.overrides = {{"supply.voltage_V", "12000mV"}, {"pwm.period_s", "\"50 us\""}}});
  ASSERT_TRUE(s) << to_string(s.problems()[0]);
  EXPECT_EQ(s->duration_s, 0.02);
  EXPECT_EQ(s->sheet.resistance_ohm->value, 0.98);
  EXPECT_EQ(s->sheet.inertia_gcm2->value, 140.0);
  EXPECT_DOUBLE_EQ(*s->control.slew, 100 * M_PI);
  EXPECT_EQ(*s->control.current.damping, 0.9);
  EXPECT_EQ(s->reference.times_s.at(1), 0.005);
  EXPECT_DOUBLE_EQ(s->reference.values.at(0), 955 * M_PI / 30);
  EXPECT_EQ(s->reference.values.at(1), 50.0);
  EXPECT_EQ(s->load.inertia_kg_m2, 1.35e-5);
  EXPECT_EQ(s->supply.voltage_V, 12.0);
  EXPECT_EQ(s->pwm.period_s, 50e-6);
  // A printed number is exact within its last digit. 980 mohm is exact within 0.001 ohm, and 1.4e-5 kg m2
  // within 1 g cm2.
  EXPECT_DOUBLE_EQ(*s->sheet.resistance_ohm->last_digit, 1e-3);
  EXPECT_DOUBLE_EQ(*s->sheet.inertia_gcm2->last_digit, 10.0);
}

TEST(Units, OfAReferenceFollowTheMode) {
  const std::string duration = "duration_s = 0.02\n";
  EXPECT_EQ(told(duration + "control.mode = \"duty\"\nreference.value = \"50 %\"\n"), "accepted");
  EXPECT_EQ(told(duration + "control.mode = \"current\"\nreference.value = \"500 mA\"\n"), "accepted");
  EXPECT_EQ(told(duration + "control.mode = \"position\"\nreference.value = \"0.25 rev\"\n"), "accepted");
  EXPECT_EQ(
      told(duration + "control.mode = \"current\"\nreference.value = \"955 rpm\"\n"),
      "x.toml:4:19: reference.value = \"955 rpm\" has the unit rpm, which cannot be converted to A; units that fit: A or mA");
  EXPECT_EQ(
      told(duration + "reference.value = \"955 rpm\"\n"),
      "x.toml:3:19: reference.value = \"955 rpm\" is in the unit of control.mode, but this mode has no unit; set control.mode, or write a number without quotes");
  EXPECT_EQ(told("duration_s = \"-20 ms\"\n"),
            "x.toml:2:14: duration_s = \"-20 ms\" must be above 0 and at most 9000000000, in ms; it means: "
            "simulated time, in s");
}

TEST(Units, ALimitIsToldInTheUnitThatWasWritten) {
  const auto told = [](const std::string& hertz) {
    const auto s = with("duration_s = 0.1\n[sensors]\ncapture_Hz = " + hertz + "\n");
    return s ? std::string("taken") : to_string(s.problems()[0]);
  };
  EXPECT_THAT(told("\"5000 MHz\""), ::testing::HasSubstr("\"5000 MHz\" must lie in 1e-06 to 1000, in MHz;"));
  EXPECT_THAT(told("\"2e6 kHz\""), ::testing::HasSubstr("must lie in 0.001 to 1000000, in kHz;"));
  EXPECT_THAT(told("5e9"), ::testing::HasSubstr("must lie in 1 to 1000000000;"));
}

TEST(Units, OfALimitFollowMetricAndSignal) {
  const auto s = with(
      "duration_s = 0.1\n[control]\nmode = \"speed\"\n"
      "[[require]]\nmetric = \"reach_time_s\"\nsignal = \"speed\"\nlevel = \"6000 rpm\"\nstart = \"1 "
      "rev/s\"\n"
      "max = \"20 ms\"\n"
      "[[require]]\nmetric = \"max\"\nmin = \"150 mA\"\nmax = 3\n"
      "[[require]]\nmetric = \"mean\"\nsignal = \"speed\"\nmin = \"6710 rpm\"\n"
      "[[require]]\nmetric = \"switching_frequency_Hz\"\nmax = \"16.6 kHz\"\n"
      "[[require]]\nmetric = \"efficiency\"\nmin = \"80 %\"\n"
      "[[require]]\nmetric = \"energy_J\"\nsignal = \"copper_loss_W\"\nmax = \"20 mJ\"\n"
      "[[require]]\nmetric = \"max\"\nsignal = \"torque\"\nmax = \"780 mNm\"\n"
      "[[compare]]\nmetric = \"final\"\nsignal = \"bus_voltage\"\nvalue = \"24000 mV\"\nsource = \"x\"\n"
      "[[spread]]\nkey = \"supply.voltage_V\"\nabsolute = \"500 mV\"\n"
      "[[spread]]\nkey = \"motor_override.inertia_gcm2\"\nabsolute = \"1e-6 kgm2\"\n[motor_override]\n"
      "inertia_gcm2 = 135\n");
  ASSERT_TRUE(s) << to_string(s.problems()[0]);
  EXPECT_EQ(s->require[0].max, 0.02);
  EXPECT_DOUBLE_EQ(*s->require[0].measure.level, 200 * sixstep::base::pi);
  EXPECT_DOUBLE_EQ(*s->require[0].measure.start, 2 * sixstep::base::pi);
  EXPECT_EQ(s->require[1].min, 0.15);
  EXPECT_EQ(s->require[1].max, 3.0);
  EXPECT_DOUBLE_EQ(*s->require[2].min, 6710 * sixstep::base::pi / 30);
  EXPECT_EQ(s->require[3].max, 16600.0);
  EXPECT_EQ(s->require[4].min, 0.8);
  EXPECT_EQ(s->require[5].max, 0.02);
  EXPECT_EQ(s->require[6].max, 0.78);
  EXPECT_EQ(s->compare[0].value, 24.0);
  EXPECT_EQ(s->spread[0].absolute, 0.5);
  EXPECT_EQ(s->spread[1].absolute, 10.0);
}

TEST(Units, OfALimitAreRefusedByMetricAndSignal) {
  const auto told = [](const std::string& keys) {
    std::string all;
    if (const auto s = with("duration_s = 0.1\n[[require]]\n" + keys); !s)
      for (const base::Problem& p : s.problems()) all += to_string(p) + "\n";
    return all;
  };
  EXPECT_EQ(
      told("metric = \"max\"\nmax = \"20 ms\"\n"),
      "x.toml:5:7: require.max = \"20 ms\" has the unit ms, which cannot be converted to A; units that fit: A or mA\n");
  EXPECT_EQ(
      told("metric = \"settling_time_s\"\nlevel = \"2 A\"\nmax = \"2 A\"\n"),
      "x.toml:6:7: require.max = \"2 A\" has the unit A, which cannot be converted to s; units that fit: s, ms, us or min\n");
  EXPECT_EQ(
      told("metric = \"efficiency\"\nmin = \"8 W\"\n"),
      "x.toml:5:7: require.min = \"8 W\" has the unit W, and this key takes a number without a unit; write the number without a unit, or with %\n");
  EXPECT_EQ(told("metric = \"max\"\nmax = \"2\"\n"),
            "x.toml:5:7: require.max = \"2\" lacks its unit; write 2, which is in A, or \"2 A\"\n");
  // The metric is misspelt, so the unit is not known. Only the misspelt word is reported.
  EXPECT_EQ(told("metric = \"maxi\"\nmax = \"20 ms\"\n").find("require.max"), std::string::npos);
  const std::string word =
      told("metric = \"max\"\nsignal = \"spede\"\nlevel = \"3 rpm\"\nmax = \"20 rpm\"\n");
  EXPECT_THAT(word, ::testing::StartsWith("x.toml:5:10: require.signal = \"spede\""));
  EXPECT_EQ(word.find('\n'), word.size() - 1) << word;
}

}  // namespace SIXSTEP_TEST_FILE
}  // namespace text

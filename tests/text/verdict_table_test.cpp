// SPDX-License-Identifier: Apache-2.0
// The table that a run prints on the terminal has short numbers. It never shows a missed requirement as if it
// were met.
#include "text/results/verdict_table.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <limits>
#include <random>

#include "text/results/core_text.hpp"
#include "text/results/quantity_text.hpp"

namespace text {
namespace SIXSTEP_TEST_FILE {

TEST(QuantityText, HasEngineeringPrefixesAndFiveDigits) {
  EXPECT_EQ(quantity_text(0.000131172659, "s"), "131.17 us");
  EXPECT_EQ(quantity_text(47250, "Hz"), "47.25 kHz");
  EXPECT_EQ(quantity_text(1e-9, "A"), "1 nA");
  EXPECT_EQ(quantity_text(0.78, "N m"), "0.78 N m");
  EXPECT_EQ(quantity_text(-0.0478213974, "A"), "-47.821 mA");
  EXPECT_EQ(quantity_text(8.8817842e-16, "A", 2), "8.9e-16 A");
  EXPECT_EQ(quantity_text(702.6127923, "rad/s"), "702.61 rad/s");
  EXPECT_EQ(quantity_text(0.00123, "1"), "0.00123");
  EXPECT_EQ(quantity_text(-0.0, "A"), "0 A");
  EXPECT_EQ(quantity_text(std::numeric_limits<double>::infinity(), "s"), "never");
  EXPECT_EQ(quantity_text(std::numeric_limits<double>::quiet_NaN(), "A"), "no value");
}

std::string table_of(study::Outcome outcome) {
  return verdict_table(std::vector<TableEntry>{{"x", &outcome}}, false);
}

TEST(VerdictTable, OneLineEachWithItsNumbersInOnePrefix) {
  study::Outcome outcome;
  outcome.verdicts = {{"settling time", "s", 0.00099, std::nullopt, 1e-3, true},
                      {"below the band", "A", 8.8817842e-16, std::nullopt, 1e-9, true}};
  outcome.comparisons = {{"switching frequency", "Hz", 47250, 16600, "solver"},
                         {"overshoot", "A", 0.374973516, 0, "none wanted"}};
  EXPECT_EQ(table_of(outcome),
            "experiment             required  measured           source\n"
            "x\n"
            "  settling time        <= 1 ms   0.99 ms    ok\n"
            "  below the band       <= 1 nA   8.9e-16 A  ok\n"
            "  switching frequency  16.6 kHz  47.25 kHz  +185 %  solver\n"
            "  overshoot            0 A       0.37497 A          none wanted\n");
}

/// Compared figures have no requirement, so the heading of their column is "expected".
TEST(VerdictTable, AColumnOfComparisonsAloneIsWhatIsExpected) {
  study::Outcome outcome;
  outcome.comparisons = {{"overshoot", "A", 0.4, 0.5, "hand"}};
  EXPECT_EQ(table_of(outcome),
            "experiment   expected  measured         source\n"
            "x\n"
            "  overshoot  0.5 A     0.4 A     -20 %  hand\n");
  outcome.verdicts = {{"settling time", "s", 0.00099, std::nullopt, 1e-3, true}};
  EXPECT_THAT(table_of(outcome), ::testing::StartsWith("experiment       required"));
}

TEST(VerdictTable, ShowsAsManyDigitsAsTellMeasuredFromLimit) {
  study::Outcome outcome;
  outcome.verdicts = {{"hair", "s", 0.0010000000003, std::nullopt, 1e-3, false},
                      {"band", "A", 23.3009709, 23.3009476, 23.3009942, true},
                      {"last bit", "V", std::nextafter(0.3, 1.0), std::nullopt, 0.3, false}};
  const std::string text = table_of(outcome);
  EXPECT_THAT(text, ::testing::HasSubstr("1.0000000003 ms"));
  EXPECT_THAT(text, ::testing::HasSubstr("23.30095 .. 23.30099 A    23.30097 A "));
  EXPECT_THAT(text, ::testing::HasSubstr("<= 0.29999999999999999 V"));
  EXPECT_THAT(text, ::testing::HasSubstr("0.30000000000000004 V"));
}

TEST(VerdictTable, WhatNeverCameIsNoNumber) {
  study::Outcome outcome;
  outcome.verdicts = {
      {"reach", "s", std::numeric_limits<double>::infinity(), std::nullopt, 1e-3, false},
      {"mean of an empty window", "A", std::numeric_limits<double>::quiet_NaN(), 1, 2, false}};
  const std::string text = table_of(outcome);
  EXPECT_THAT(text, ::testing::HasSubstr("<= 1 ms   never     FAILED"));
  EXPECT_THAT(text, ::testing::HasSubstr("1 .. 2 A  no value  FAILED"));
  outcome.comparisons = {{"reach", "s", std::numeric_limits<double>::infinity(), 5e-3, "hand"},
                         {"THD", "1", std::numeric_limits<double>::quiet_NaN(), 0.3, "hand"}};
  EXPECT_THAT(table_of(outcome), ::testing::HasSubstr("5 ms      never     not comparable  hand"));
  EXPECT_THAT(table_of(outcome), ::testing::HasSubstr("0.3       no value  not comparable  hand"));
}

TEST(ComparedTexts, NeverGiveDifferentNumbersOneText) {
  constexpr unsigned seed = 20261;
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> exponent(-14, 8);
  for (int n = 0; n < 20000; ++n) {
    const double limit = std::pow(10.0, exponent(random));
    const double x =
        n % 2 ? std::nextafter(limit, 1e30) : limit * (1 + std::pow(10.0, exponent(random)) * 1e-8);
    if (x == limit) continue;
    const ComparedTexts texts = compared_texts(x, std::array{limit}, "A");
    ASSERT_NE(texts.x, texts.yardsticks[0] + " " + texts.unit) << seed << " " << n << " " << limit;
  }
}

TEST(VerdictTable, RoundingIsNoDeviation) {
  EXPECT_EQ(deviation_text({"f", "Hz", 16600 * (1 + 2e-16), 16600, ""}), "0 %");
  study::Outcome outcome;
  outcome.comparisons = {{"f", "Hz", 16600 * (1 + 2e-16), 16600, "s"}};
  EXPECT_THAT(table_of(outcome), ::testing::HasSubstr("16.6 kHz  16.6 kHz  0 %  s"));
  EXPECT_EQ(deviation_text({"f", "Hz", 16558.5, 16600, ""}), "-0.25 %");
  EXPECT_EQ(deviation_text({"f", "A", -0.02, 0, ""}), "");
}

/// If a percentage has no meaning, the table shows a factor, a difference, or kelvin. Kelvin do not depend on
/// the zero of the scale.
TEST(VerdictTable, WhereAPercentageSaysNothing) {
  EXPECT_EQ(deviation_text({"f", "A", 15.6, 1, ""}), "x 15.6");
  EXPECT_EQ(deviation_text({"f", "A", 10.9, 1, ""}), "+990 %");
  EXPECT_EQ(deviation_text({"f", "A", 2, 1e-6, ""}), "+2 A");
  EXPECT_EQ(deviation_text({"f", "degC", 46, 40, ""}), "+6 K");
  EXPECT_EQ(deviation_text({"f", "degC", 319, 313, ""}), "+6 K");
}

/// In one column, the printed numbers have one unit and the order of their values. Each number is accurate to
/// its last digit.
TEST(SharedPrefix, KeepsTheOrderOfAColumn) {
  std::mt19937 random(4);
  std::uniform_real_distribution<double> decades(-7, 4), within(0, 3.9);
  for (int draw = 0; draw < 2000; ++draw) {
    const double low = std::pow(10.0, decades(random));
    std::vector<double> values;
    for (int n = 0; n < 5; ++n) values.push_back(low * std::pow(10.0, within(random)));
    const SharedPrefix prefix(values, "V");
    std::vector<double> printed;
    std::string unit;
    for (const double x : values) {
      const std::string text = prefix.text(x, 4);
      const std::size_t blank = text.find(' ');
      ASSERT_NE(blank, text.npos) << text;
      printed.push_back(std::stod(text));
      if (unit.empty()) unit = text.substr(blank);
      EXPECT_EQ(text.substr(blank), unit) << text;
      EXPECT_LT(printed.back(), 1e5) << text;
      EXPECT_NEAR(printed.back() / printed.front(), x / values.front(), 2e-3 * x / values.front()) << text;
    }
  }
  const std::vector<double> apart{1e-6, 2.0};
  EXPECT_EQ(SharedPrefix(apart, "V").text(1e-6), "1 uV");
  EXPECT_EQ(SharedPrefix(apart, "V").text(2.0), "2 V");
}

TEST(VerdictSummary, SaysHowManyAndWhich) {
  study::Outcome good, bad, stopped, free;
  good.verdicts = {{"a", "A", 1, std::nullopt, 2, true}, {"b", "A", 1, std::nullopt, 2, true}};
  bad.verdicts = {{"a", "A", 1, std::nullopt, 2, true}, {"final current", "A", 3, std::nullopt, 2, false}};
  stopped.fault = base::Problem{.where = "shoot-through", .value = {}, .limit = {}, .cure = {}};
  const auto summary = [](std::vector<TableEntry> entries) { return verdict_summary(entries, false); };
  EXPECT_EQ(summary({{"x", &good}}), "1 experiment: all 2 requirements hold\n");
  EXPECT_EQ(summary({{"x", &good}, {"y", &bad}}),
            "2 experiments: 1 of 4 requirements FAILED\n  y: final current\n");
  EXPECT_EQ(summary({{"x", &good}, {"z", &stopped}}),
            "2 experiments: all 2 requirements hold, 1 stopped by a fault\n  z: stopped by a fault\n");
  EXPECT_EQ(summary({{"x", &free}}), "1 experiment: nothing required\n");
  EXPECT_THAT(table_of(stopped), ::testing::HasSubstr("STOPPED by a fault: shoot-through"));
  EXPECT_THAT(table_of(free), ::testing::HasSubstr("requires nothing"));
}

study::Outcome of_chip(const std::string& sent) {
  study::Outcome outcome;
  outcome.chip.emplace();
  outcome.chip->clock_Hz = 16e6;
  outcome.chip->sent = sent;
  return outcome;
}

TEST(ChipFaults, AreWhatItsSerialLineGivesAsReasonsEachOnce) {
  using ::testing::ElementsAre, ::testing::IsEmpty;
  EXPECT_THAT(chip_faults(*of_chip("# a board\nt [us],hall\n100,5\n").chip), IsEmpty());
  EXPECT_THAT(chip_faults(*of_chip("# a board\n100,5\n# fault: hall\n200,0\n# fault: hall\n").chip),
              ElementsAre("hall"));
  EXPECT_THAT(
      chip_faults(*of_chip("# fault: over-current\n# a board\n# fault: watchdog\n# fault: watchdog\n").chip),
      ElementsAre("over-current", "watchdog"));
  EXPECT_THAT(chip_faults(*of_chip("# fault: a\x80\x1b[2J\n").chip), ElementsAre("a??[2J"))
      << "any firmware may send anything";
}

TEST(ChipFaults, AreToldBelowTheTableAndAWaitIsWhereItIsTheLastRemark) {
  using ::testing::Contains, ::testing::HasSubstr, ::testing::Not;
  EXPECT_THAT(core_texts(of_chip("# a board\n# fault: hall\n")),
              Contains(HasSubstr("reason on its serial line: hall")));
  EXPECT_THAT(core_texts(of_chip("# a board\n# waits for the middle\n")),
              Contains(HasSubstr("waits for the middle")));
  EXPECT_THAT(core_texts(of_chip("# a board\n# waits for the middle\n# fault: hall\n")),
              Not(Contains(HasSubstr("WAITS"))));
}

}  // namespace SIXSTEP_TEST_FILE
}  // namespace text

// SPDX-License-Identifier: Apache-2.0
// A mark within a number is read as a decimal mark only if the file allows no other reading: 2,940 mV must
// not become 2.94 mV.
#include "tests/text/emf_by_formula.hpp"

namespace text {
namespace SIXSTEP_TEST_FILE {

using namespace emf_by_formula;
using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::StartsWith;

/// A whole number with a mark between the thousands, as meters show millivolts: 2940 is "2,940".
std::string grouped(double x, char mark) {
  const std::string digits = fmt::format("{:.0f}", std::fabs(x));
  const std::string sign = x < 0.0 && digits != "0" ? "-" : "";
  if (digits.size() < 4) return sign + digits;
  return sign + digits.substr(0, digits.size() - 3) + mark + digits.substr(digits.size() - 3);
}

std::string in_millivolts(const char* head, const char* format, char mark) {
  return table(head, [&](int, double t, double a, double b) {
    return fmt::format(fmt::runtime(format), 1e3 * t, grouped(1e3 * a, mark), grouped(1e3 * b, mark));
  });
}

std::string told(const std::string& file) {
  const auto recording = read_recording("r.csv", file);
  return recording ? "" : to_string(recording.problems()[0]);
}

TEST(DecimalMarks, CommasBesidePointsAreRefusedWithBothCells) {
  EXPECT_EQ(
      seen(in_millivolts("t (ms)\tu_ab (mV)\tu_bc (mV)\n", "{:.1f}\t{}\t{}\n", ',')).problem,
      "r.csv:2: contains 3,784, and line 2 contains 0.0: either mark may be the decimal mark; write thousands without a separator, for example 2940, and use one decimal mark, or remove the column");
  EXPECT_THAT(told("t;u\n0,5;1,5\n1;1.025\n"),
              AllOf(StartsWith("r.csv:3: contains 1.025, and line 2 contains 0,5")));
}

TEST(DecimalMarks, AMarkFromAThousandOnIsRefused) {
  for (const char mark : {',', '.'})
    EXPECT_THAT(seen(in_millivolts("t (ms);u_ab (mV);u_bc (mV)\n", "{:.0f}0;{};{}\n", mark)).problem,
                AllOf(StartsWith(fmt::format("r.csv:2: contains 3{}784 beside ", mark)),
                      HasSubstr("may mean 3784 or 3.784")));
  EXPECT_THAT(told("t;rpm\n0;2,865\n1;2,870\n"), HasSubstr("contains 2,865, which may mean 2865 or 2.865"));
  // Spreadsheets may show thousands separators in every column.
  EXPECT_THAT(told("ms;rpm\n1000;2,865\n2000;2,870\n"), HasSubstr("may mean 2865 or 2.865"));
}

/// A number in quotes is one cell. The comma in it must not shift the columns after the cell.
TEST(DecimalMarks, ACommaWithinQuotesPartsNoCells) {
  for (const char* head : {"t (ms),u_ab (mV),u_bc (mV)\n", ""})
    EXPECT_THAT(seen(in_millivolts(head, "{:.1f},\"{}\",\"{}\"\n", ','), between_lines).problem,
                HasSubstr("either mark may be the decimal mark"));
  const auto named = read_recording("r.csv", "\"time, of the shot [s]\",\"u_ab, mV\"\n0,\"1\"\n1,2\n3,4\n");
  ASSERT_TRUE(named);
  EXPECT_EQ(named->columns.size(), 2u);
  EXPECT_EQ(named->columns[1].name, "u_ab");
  EXPECT_THAT(named->columns[1].values, ElementsAre(1e-3, 2e-3, 4e-3));
}

TEST(DecimalMarks, DecimalCommasAreReadWhereOneCellCanBeNothingElse) {
  const auto second = [](const char* file) {
    const auto recording = read_recording("r.csv", file);
    return recording ? recording->columns[1].values : std::vector<double>{};
  };
  EXPECT_THAT(second("t;u\n0,125;1,025\n0,250;2,000\n"), ElementsAre(1.025, 2.0));
  EXPECT_THAT(second("t;u\n0;1,025\n1;-0,500\n"), ElementsAre(1.025, -0.5));
  EXPECT_THAT(second("t;u\n0;1,025\n1;1,5\n"), ElementsAre(1.025, 1.5));
  EXPECT_THAT(second("t\tu\n0\t1,025E+00\n1\t2,000E+00\n"), ElementsAre(1.025, 2.0));
  EXPECT_THAT(second("t;u\n0;1,025\n1;1200\n"), ElementsAre(1.025, 1200.0));
  EXPECT_THAT(second("t,u\n\"0,5\",\"1,025\"\n\"1,0\",\"2,5\"\n"), ElementsAre(1.025, 2.5));
  EXPECT_THAT(second("t;u\n0;1234,567\n1;1,025\n"), ElementsAre(1234.567, 1.025));
}

/// If semicolons separate the cells, the decimal mark is a comma. A point may then separate thousands, if the
/// column has no smaller number.
TEST(DecimalMarks, PointsBetweenSemicolonsMayPartThousands) {
  EXPECT_THAT(told("ms;rpm\n0;1.000\n1;1.500\n"), HasSubstr("contains 1.000, which may mean 1000 or 1.000"));
  EXPECT_EQ(told("ms;rpm\n0.5;1.000\n1;1.500\n"), "");
  EXPECT_EQ(told("ms,V\n0,1.000\n1,1.500\n"), "");
}

TEST(DecimalMarks, DecimalPointsAreRead) {
  const auto second = [](const char* file) {
    const auto recording = read_recording("r.csv", file);
    return recording ? recording->columns[1].values : std::vector<double>{};
  };
  EXPECT_THAT(second("t,u\n0,1.025\n1,2.000\n"), ElementsAre(1.025, 2.0));
  EXPECT_THAT(second("t,u\n0,1.025\n1,2\n"), ElementsAre(1.025, 2.0));
  EXPECT_THAT(second("t,u\n0,1.025\n1,100\n2,0.5\n"), ElementsAre(1.025, 100.0, 0.5));
}

/// A rate that may mean 10 Hz or 10 000 Hz is ignored. A file with a time column does not need a rate.
TEST(DecimalMarks, ARateWithAMarkIsNotTaken) {
  for (const char* rate : {"Samplerate: 10,000 Hz\n", "Sample Rate;10,000\n"}) {
    expect_right(rate + replaced(plain("Time [s],u_ab,u_bc\n"), ",", ";"));
    EXPECT_THAT(told(rate + std::string("u_ab;u_bc\n1;2\n2;3\n")), "");
    EXPECT_THAT(seen(rate + std::string("u_ab;u_bc\n1;2\n2;3\n")).problem,
                HasSubstr("has no column of time"));
  }
}

}  // namespace SIXSTEP_TEST_FILE
}  // namespace text

// SPDX-License-Identifier: Apache-2.0
// Tables that instruments export are read. Any other file causes one message with the position and the
// remedy.
#include "text/recording/recording.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include "sixstep/analysis/identification/emf/emf.hpp"
#include "sixstep/analysis/identification/hall/identify.hpp"
#include "text/recording/bench_recordings.hpp"
#include "text/recording/times.hpp"

namespace text {
namespace SIXSTEP_TEST_FILE {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::EndsWith;
using ::testing::HasSubstr;
using ::testing::SizeIs;
using ::testing::StartsWith;

Recording read(const std::string& csv) {
  const auto recording = read_recording("r.csv", csv);
  EXPECT_TRUE(recording) << to_string(recording.problems()[0]);
  return recording ? *recording : Recording{};
}

/// The text of the only message. Empty if there is no problem.
std::string told(const base::Problems& problems) {
  EXPECT_LE(problems.size(), 1u);
  return problems.empty() ? "" : to_string(problems[0]);
}
std::string told_of_hall(const std::string& csv, const BenchColumns& columns = {}) {
  const auto recording = read_recording("r.csv", csv);
  if (!recording) return told(recording.problems());
  Notes notes;
  const auto log = hall_log_of(*recording, columns, notes);
  if (!log) return told(log.problems());
  const auto found = analysis::identify(*log);
  return found ? "" : told(found.problems());
}
std::string told_of_emf(const std::string& csv, const BenchColumns& columns = {}) {
  const auto recording = read_recording("r.csv", csv);
  if (!recording) return told(recording.problems());
  Notes notes;
  const auto record = emf_record_of(*recording, columns, notes);
  if (!record) return told(record.problems());
  const auto found = analysis::measure_emf({*record, {}, {}});
  return found ? "" : told(found.problems());
}

constexpr int codes[] = {4, 6, 2, 3, 1, 5};  // docs/reference/notation.md, forward

/// A log with ten rows in each sector.
std::string hall_log(int sectors, const char* heading = "time [s],hall1,hall2,hall3\n") {
  std::string out = heading;
  for (int row = 0; row < 10 * sectors; ++row) {
    const int code = codes[row / 10 % 6];
    out += fmt::format("{},{},{},{}\n", 1e-3 * row, code >> 2 & 1, code >> 1 & 1, code & 1);
  }
  return out;
}

/// A recording with a hundred rows in each period of a sine of 20 ms.
std::string scope(double periods, double peak_V = 3.0, const char* heading = "time [s],u_ab [V]\n") {
  std::string out = heading;
  for (int row = 0; row < 100 * periods; ++row)
    out += fmt::format("{},{}\n", 2e-4 * row, peak_V * std::sin(0.062831853 * row));
  return out;
}

TEST(Recording, HeadingsWithUnitsUnitsBelowThemAndNone) {
  const Recording own = read("time [ms],u_ab (mV),u_bc_V\n0,1,2\n1,3,4\n");
  ASSERT_THAT(own.columns, SizeIs(3));
  EXPECT_EQ(own.columns[0].name, "time");
  EXPECT_EQ(own.columns[0].unit, "ms");
  EXPECT_EQ(own.columns[1].unit, "mV");
  EXPECT_EQ(own.columns[2].name, "u_bc");
  EXPECT_EQ(own.columns[2].unit, "V");
  EXPECT_EQ(own.line_of(0), 2u);
  EXPECT_EQ(own.line_of(1), 3u);
  Notes notes;
  EXPECT_THAT(times_of(own, {}, notes)->t_s, ElementsAre(0.0, 1e-3));
  EXPECT_THAT(*values_of(own, {&own.columns[1], "mV"}, "V"), ElementsAre(1e-3, 3e-3));

  const Recording keysight = read("x-axis,1,2\nsecond,Volt,Volt\n-1e-3,+1.5E+00,2\n0,1,2\n");
  EXPECT_EQ(keysight.columns[1].name, "1");
  EXPECT_EQ(keysight.columns[1].unit, "V");
  EXPECT_THAT(times_of(keysight, {}, notes)->t_s, ElementsAre(-1e-3, 0.0));

  const Recording bare = read("0,1.5\n1e-3,2\n3e-3,2.5\n");
  EXPECT_EQ(bare.columns[1].name, "column 2");
  EXPECT_THAT(times_of(bare, {}, notes)->t_s, ElementsAre(0.0, 1e-3, 3e-3));
  EXPECT_THAT(times_of(bare, 0.5, notes)->t_s, ElementsAre(0.0, 0.5, 1.0));
}

TEST(Recording, PreambleRemarksAndEverySeparator) {
  const std::string preamble = "Model,SDS1104\n# a remark\nRecord Length,3\n\nSource,CH1\n";
  EXPECT_EQ(read(preamble + "Second,Value\n0,1\n1e-3,2\n").columns[1].values[1], 2.0);
  for (const char* const table : {"t;u\n0;1,5\n0,001;2\n", "t\tu\n0\t1,5\n0,001\t2\n", "t,u\n0,1.5\n.001,2\n",
                                  "  t   u\n  0   1.5\n  1e-3 2\n", "\xef\xbb\xbft;u\r\n0;1.5\r\n0.001;2\r\n",
                                  "\"t\",\"u\"\n\"0\",\"1.5\"\n\"0.001\",\"2\"\n"}) {
    const Recording r = read(table);
    ASSERT_THAT(r.columns, SizeIs(2)) << table;
    EXPECT_EQ(r.columns[0].name, "t") << table;
    EXPECT_THAT(r.columns[0].values, ElementsAre(0.0, 0.001)) << table;
    EXPECT_THAT(r.columns[1].values, ElementsAre(1.5, 2.0)) << table;
  }
}

TEST(Recording, GoodOnesAreTakenOrNoneOfTheRestWouldTell) {
  EXPECT_EQ(told_of_hall(hall_log(36)), "");
  EXPECT_EQ(told_of_emf(scope(4)), "");
}

TEST(Recording, WhatIsNoTable) {
  EXPECT_EQ(told_of_hall(""), "r.csv: is empty; export the recording again: headings, then rows of numbers");
  EXPECT_EQ(told_of_hall(" \r\n\t\n"), told_of_hall(""));
  const std::string gz("\x1f\x8b\x08\x00\x00\x00rest", 10);
  EXPECT_EQ(told_of_emf(gz),
            "r.csv: is not a text file; export the recording as CSV, or unpack a .gz with gzip -d");
  EXPECT_THAT(told_of_emf("\x1f\x8b\x08\x08\x1c\xffno zero among these"),
              StartsWith("r.csv:1: contains no row of numbers; export the recording as text"));
  EXPECT_THAT(told_of_emf("time,u_ab\n"), StartsWith("r.csv:1: contains no row of numbers"));
  EXPECT_THAT(told_of_emf("<html>\n<p>Sign in</p>\n</html>\n"),
              StartsWith("r.csv: contains no row of numbers"));
  std::string words;
  for (int n = 0; n < 500; ++n) words += "one line of a letter\n";
  EXPECT_THAT(told_of_emf(words), StartsWith("r.csv: contains no row of numbers"));
}

TEST(Recording, CellsThatAreNoNumbersAreNamedByTheirLine) {
  const auto changed = [](const char* cell) {
    return "time [s],u_ab [V]\n0,1\n1e-3," + std::string(cell) + "\n2e-3,3\n";
  };
  for (const char* const cell : {"nan", "NaN", "inf", "-inf", "--", "OL", "1e", "0x10", "1.2.3", "1 2", ""})
    EXPECT_EQ(told_of_emf(changed(cell)),
              fmt::format(
                  "r.csv:3: u_ab \"{}\" is not a number; remove such rows, and write numbers as 0.5 or 5e-1",
                  cell));
  EXPECT_THAT(told_of_emf("time [s],u_ab [V]\n0,1\n1e-3\n"),
              StartsWith("r.csv:3: u_ab \"\" is not a number"));
  EXPECT_THAT(told_of_emf("time [s],u_ab [V]\n0,1\nnever,2\n"),
              StartsWith("r.csv:3: time \"never\" is not a number"));
  EXPECT_THAT(told_of_emf(scope(2) + "0.5,\xff\xfe\n"), HasSubstr("is not a number"));
  // A column that is not used may contain any text.
  std::string remarked = "time [s],u_ab [V],remark\n";
  for (int row = 0; row < 400; ++row)
    remarked += fmt::format("{},{},n/a\n", 2e-4 * row, std::sin(0.0628 * row));
  EXPECT_EQ(told_of_emf(remarked), "");
}

TEST(Recording, NumbersBeyondAllInstrumentsAreNamedByTheirRow) {
  for (const char* const huge : {"1e300", "-1e13", "1e308"})
    EXPECT_THAT(told_of_emf(scope(2) + fmt::format("1,{}\n", huge)),
                AllOf(StartsWith("r.csv: u_ab "), HasSubstr(" in row 201 is too large for any instrument")));
  EXPECT_THAT(told_of_emf(scope(2) + "1e200,0\n"), StartsWith("r.csv: time 1e+200 in row 201 is too large"));
  EXPECT_THAT(told_of_emf(scope(2) + "1,1e999\n"), StartsWith("r.csv:202: u_ab \"1e999\" is not a number"));
}

TEST(Recording, TimesThatDoNotTell) {
  EXPECT_EQ(
      told_of_emf("u_ab [V],u_bc [V]\n1,2\n2,3\n"),
      "r.csv: has no column of time: it has u_ab, u_bc; write the heading time [s], or give the interval of the rows");
  EXPECT_THAT(told_of_emf("sample,u_ab\n0,1\n1,2\n2,3\n"),
              StartsWith("r.csv: has no column of time: it has sample, u_ab"));
  EXPECT_THAT(
      told_of_emf("time,u_ab\n0,1\n1,2\n2,3\n"),
      StartsWith(
          "r.csv: has no time: its column time contains only row numbers; write the heading time [s]"));
  EXPECT_THAT(told_of_emf(scope(2) + "0.001,1\n"),
              StartsWith("r.csv: time 0.001 in row 201 does not rise; give the rows in the order"));
  EXPECT_THAT(told_of_emf("time [V],u_ab [V]\n0,1\n1,2\n"),
              StartsWith("r.csv: has the heading time in V, but s is expected; name another column"));
}

/// A given interval replaces a missing time, but does not override the time in the file.
TEST(Recording, AnIntervalBesideATime) {
  const auto times = [](const char* csv, double interval_s) {
    Notes notes;
    const auto found = times_of(read(csv), interval_s, notes);
    return found ? found->t_s : std::vector<double>{};
  };
  using ::testing::DoubleEq;
  EXPECT_THAT(times("time [ms],u\n2,1\n4,2\n6.1,3\n", 2e-3),
              ElementsAre(DoubleEq(2e-3), DoubleEq(4e-3), DoubleEq(6.1e-3)));
  EXPECT_THAT(times("time,u\n0,1\n1,2\n2,3\n", 0.5), ElementsAre(0.0, 0.5, 1.0));
  EXPECT_THAT(times("time,u\n10,1\n20,2\n30,3\n", 1e-2), ElementsAre(0.01, 0.02, 0.03));  // in ms
  // The time has too few digits. The rows are really 0.4 ms apart.
  EXPECT_THAT(
      times("time [ms],u\n5,1\n5,2\n5,3\n6,4\n6,5\n", 4e-4),
      ElementsAre(DoubleEq(5e-3), DoubleEq(5.4e-3), DoubleEq(5.8e-3), DoubleEq(6.2e-3), DoubleEq(6.6e-3)));
  EXPECT_THAT(times("time [ms],u\n2,1\n4,2\n6,3\n", 1e-3), ElementsAre());
  EXPECT_THAT(times("time [ms],u\n2,1\n4,2\n8,3\n", 2e-3), ElementsAre());  // a row is missing
  EXPECT_THAT(times("Samplerate: 1 kHz\nu,v\n2,1\n4,2\n", 1e-3), ElementsAre(0.0, 1e-3));
  EXPECT_THAT(times("Samplerate: 1 kHz\nu,v\n2,1\n4,2\n", 1e-2), ElementsAre());
  // If the columns have no headings and the first column cannot be the time, it is a voltage.
  EXPECT_THAT(times("3,1\n1,2\n2,3\n", 0.5), ElementsAre(0.0, 0.5, 1.0));
  Notes notes;
  const auto record = emf_record_of(
      read("3,1\n1,2\n2,3\n"),
      {.hall = {}, .voltages = {}, .between = analysis::EmfBetween::lines, .interval_s = 0.5}, notes);
  ASSERT_TRUE(record);
  EXPECT_THAT(record->channels, SizeIs(2));
}

TEST(Recording, WrongColumns) {
  EXPECT_EQ(
      told_of_hall(scope(3)),
      "r.csv: has no columns of Hall lines: it has time, u_ab; write the headings hall1, hall2 and hall3, or hall above a column of codes, or name the columns with --hall");
  EXPECT_EQ(
      told_of_hall(hall_log(36),
                   {.hall = {"hall1", "hall2", "hal3"}, .voltages = {}, .between = {}, .interval_s = {}}),
      "r.csv: has no column \"hal3\"; did you mean \"hall3\"?");
  EXPECT_THAT(told_of_hall(hall_log(36),
                           {.hall = {"hall1", "hall2"}, .voltages = {}, .between = {}, .interval_s = {}}),
              StartsWith("r.csv: does not have three columns of Hall lines"));
  EXPECT_THAT(told_of_hall("time [s],hall\n0,4\n1e-3,8\n"),
              StartsWith("r.csv: hall 8 in row 2 is not a Hall code, 0 to 7"));
  EXPECT_THAT(told_of_hall("time [s],hall\n0,4\n1e-3,4.5\n"),
              StartsWith("r.csv: hall 4.5 in row 2 is not a Hall code, 0 to 7"));
  EXPECT_THAT(told_of_hall(hall_log(36, "time [s],hall1 [s],hall2,hall3\n")),
              StartsWith("r.csv: has the heading hall1 in s, but V is expected"));
  EXPECT_THAT(told_of_emf("time [s]\n0\n1\n3\n"),
              StartsWith("r.csv: has no column of voltages: it has time"));
  EXPECT_THAT(told_of_emf(scope(4, 3.0, "time [s],CH1 [V]\n")),
              StartsWith("between is missing, and the headings do not tell between which points"));
  EXPECT_THAT(told_of_hall("time [s],hall,u_ab\n0,4,1\n1e-3,4,1\n"),
              StartsWith("r.csv: has 1 voltage of lines; give u_ab and u_bc"));
}

/// With a wrong separator, the file seems to have only one column.
TEST(Recording, WrongSeparators) {
  EXPECT_THAT(told_of_hall("time|hall1|hall2|hall3\n0|1|0|0\n1|1|1|0\n"),
              StartsWith("r.csv: contains no row of numbers"));
  EXPECT_THAT(told_of_emf("time,u_ab\n0,0,1,5\n0,001,2,5\n"),
              AllOf(StartsWith("r.csv:2: has 4 cells below 2 headings"),
                    HasSubstr("; export the file with semicolons")));
}

TEST(Recording, TooShortStandingOrDead) {
  EXPECT_THAT(told_of_hall(hall_log(12)), StartsWith("hall1, hall2, hall3 pass 11 edges; 18 are needed"));
  EXPECT_THAT(told_of_hall("time [s],hall\n0,4\n"), StartsWith("time = 1 rows are too few"));
  EXPECT_THAT(told_of_hall(hall_log(1)),
              StartsWith("hall1, hall2, hall3 never change: the rotor was at rest"));
  std::string dead = hall_log(36);
  for (std::size_t end = dead.find('\n', dead.find('\n') + 1); end != std::string::npos;
       end = dead.find('\n', end + 1))
    dead[end - 1] = '0';
  EXPECT_THAT(told_of_hall(dead), StartsWith("hall3 = 0 in every row, while another line changes "));
  EXPECT_THAT(told_of_emf(scope(4, 0.0)), StartsWith("u_ab = 0 V in every row: the motor was at rest"));
  EXPECT_THAT(told_of_emf(scope(1.2)), HasSubstr("period"));
  EXPECT_THAT(told_of_emf("time [s],u_ab [V]\n0,1\n1,2\n2.5,1\n"), StartsWith("time = 3 rows are too few"));
}

/// Quotations in a message are short, whatever the file contains, because a person reads them.
TEST(Recording, WhatIsQuotedIsShort) {
  const std::string endless(1'000'000, 'x');
  for (const std::string& csv :
       {endless, endless + "," + endless + "\n0,1\n1,2\n", "time [s]," + endless + "\n0," + endless + "\n",
        "time [s],hall" + endless + "\n0,1\n1e-3,2\n3e-3,3\n", endless + " [V]\n0\n1\n",
        "time [s]," + endless + " [V]\n0,1\n1,1e200\n3,1\n"}) {
    for (const std::string& message :
         {told_of_hall(csv), told_of_emf(csv),
          told_of_hall(csv, {.hall = {endless}, .voltages = {endless}, .between = {}, .interval_s = {}})}) {
      EXPECT_GT(message.size(), 20u);
      EXPECT_LT(message.size(), 2500u) << message.substr(0, 300);
    }
  }
}

}  // namespace SIXSTEP_TEST_FILE
}  // namespace text

// SPDX-License-Identifier: Apache-2.0
// Tests incomplete and contradictory recordings. A message refuses a recording with the reason, or names the
// parts that are not used.
#include "tests/text/emf_by_formula.hpp"

namespace text {
namespace SIXSTEP_TEST_FILE {

using namespace emf_by_formula;
using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::SizeIs;

TEST(RecordedDoubts, WordsThatAreNoUnitsAreRefused) {
  for (const char* head :
       {"time (us),u_ab [counts],u_bc [counts]\n", "time (us),u_ab (dBV),u_bc (dBV)\n",
        "time (us),u_ab [counts],u_bc [V]\n", "time (us),u_ab_counts,u_bc_counts\n",
        "time (us),CH1 raw,CH2 raw\n", "time (us),CH1 in LSB,CH2 in LSB\n",
        "time (us),u_ab / div,u_bc / div\n", "Time (foo),u_ab [V],u_bc [V]\n", "time [ticks],u_ab,u_bc\n",
        "time samples,u_ab,u_bc\n", "t,u_ab,u_bc\n(foo),(V),(V)\n", "t,u_ab,u_bc\ns,foo,V\n",
        "t,u_ab,u_bc\nfoo,V,V\n", "t,CH1,CH2\ns,V,foo\n"}) {
    const Seen found = seen(plain(head, "{:.0f},{:.5f},{:.5f}\n", 1e6), between_lines);
    EXPECT_THAT(found.problem, AllOf(HasSubstr("which is not a unit"), HasSubstr("units that fit: ")))
        << head;
  }
  EXPECT_THAT(seen(plain("time [s],u_ab [A],u_bc [A]\n")).problem,
              HasSubstr("has the heading u_ab in A, but V is expected"));
}

/// The unit in the heading contradicts the unit in the row below the heading. In Tektronix files, this row is
/// above the heading.
TEST(RecordedDoubts, UnitsThatContradictEachOtherAreRefused) {
  for (const char* head :
       {"time [s],u_ab (mV),u_bc (mV)\ns,V,V\n", "Vertical Units,V,V\ntime [s],u_ab (mV),u_bc (mV)\n"})
    EXPECT_THAT(seen(plain(head), between_lines).problem, HasSubstr("has the heading u_ab in \"mV and V\""))
        << head;
}

TEST(RecordedDoubts, UnitsAboveTheHeadingsCount) {
  const auto volts_of = [](const char* units) {
    const auto recording = read_recording("r.csv", std::string("Horizontal Units,s\nVertical Units,") +
                                                       units + "\nTIME,CH1,CH2\n0,1,2\n1e-3,3,4\n");
    return recording ? recording->columns[2].values : std::vector<double>{};
  };
  EXPECT_THAT(volts_of("mV,mV"), ElementsAre(2e-3, 4e-3));
  EXPECT_THAT(volts_of("mV,V"), ElementsAre(2.0, 4.0));
  const auto amps = read_recording("r.csv", "Horizontal Units,s\nVertical Units,A\nTIME,CH1\n0,1\n1e-3,3\n");
  ASSERT_TRUE(amps);
  EXPECT_EQ(amps->columns[1].unit, "A");
}

/// The option --columns names sixstep's columns, so i_m_A is i_m in A, not i in m/A.
TEST(RecordedDoubts, AKnownNameComesBeforeAUnit) {
  const auto read = read_recording("r.csv", "t_s,i_m_A,i_m,speed_rad_s\n0,1,2,3\n");
  ASSERT_TRUE(read);
  std::vector<std::string> names, units;
  for (const RecordedColumn& column : read->columns) {
    names.push_back(column.name);
    units.push_back(column.unit);
  }
  EXPECT_THAT(names, ElementsAre("t", "i_m_A", "i_m", "speed"));
  EXPECT_THAT(units, ElementsAre("s", "A", "", "rad/s"));
}

/// A letter at the end of a name is not read as a unit if this unit does not fit the column.
TEST(RecordedDoubts, LettersThatArePhases) {
  for (const char* head : {"time,phase_A,phase_B,phase_C\n", "time,phase A,phase B,phase C\n",
                           "time,u_A,u_B,u_C\n", "time,U_a,U_b,U_c\n"}) {
    const std::string file = table(head, [](int, double t, double a, double b) {
      return fmt::format("{:.6f},{:.5f},{:.5f},{:.5f}\n", t, a, b, -a - b);
    });
    EXPECT_EQ(seen(file).problem, "") << head;
    EXPECT_THAT(seen(file).channels, SizeIs(3)) << head;
  }
}

TEST(RecordedDoubts, ADecimalCommaBetweenCommasIsNamed) {
  for (const char* head : {"time [s],u_ab [V],u_bc [V]\n", ""})
    EXPECT_THAT(seen(with_commas(plain(head)), between_lines).problem,
                AllOf(HasSubstr("commas are both decimal marks and separators"), HasSubstr("semicolons")));
}

TEST(RecordedDoubts, RowsOfMoreCellsThanHeadingsAreToldOf) {
  EXPECT_THAT(seen(plain("time [s],u_ab [V],u_bc [V]\n") + "0.06,1.5,2.5,3.5\n").problem,
              HasSubstr("r.csv:502: has 4 cells, but the table has 3 columns"));
}

/// An instrument writes a word for a missing sample. This word must not remove a channel without a message.
TEST(RecordedDoubts, ABadCellIsNamed) {
  for (const char* cell : {"\xe2\x88\x9e", "-\xe2\x88\x9e", "NaN", "nan", "inf", "-inf", "OL", "---", "***",
                           "#N/A", "1.#INF", "-1.#IND", "", "  ", "overflow"})
    for (const char* head : {"Time [s],Channel 0,Channel 1\n", "time [s],u_ab,u_bc\n",
                             "Time,Kanal A,Kanal B\n(s),(V),(V)\n", ""}) {
      const std::string file = table(head, [&](int n, double t, double a, double b) {
        return n == 7 || n == 9 ? fmt::format("{:.6f},{:.5f},{}\n", t, a, cell)
                                : fmt::format("{:.6f},{:.5f},{:.5f}\n", t, a, b);
      });
      const std::size_t above =
          static_cast<std::size_t>(std::count(head, head + std::string(head).size(), '\n'));
      const Seen found = seen(file, between_lines);
      EXPECT_THAT(found.problem, AllOf(HasSubstr(fmt::format("r.csv:{}: ", above + 8)),
                                       HasSubstr("is not a number, and 1 more cell")))
          << cell << head;
    }
}

TEST(RecordedDoubts, ColumnsThatAreNotUsedAreNamed) {
  const std::string file =
      table("time [s],u_ab,u_bc,Remark,Temp [degC],aux\n", [](int n, double t, double a, double b) {
        return fmt::format("{:.6f},{:.5f},{:.5f},fine,21.5,{}\n", t, a, b, n % 3);
      });
  EXPECT_THAT(
      seen(file).notes,
      ElementsAre(
          "not used: Remark (holds no numbers), Temp (in degC), aux (its heading has no known meaning)"));
  const std::string four = table("time [s],CH1,CH2,CH3,CH4\n", [](int, double t, double a, double b) {
    return fmt::format("{:.6f},{:.5f},{:.5f},{:.5f},{:.5f}\n", t, a, b, -a - b, a);
  });
  EXPECT_THAT(seen(four, between_lines).notes, ElementsAre("not used: CH4 (more than 3 voltages)"));
}

TEST(RecordedDoubts, VoltagesThatAreNamedSayWhatTheyAreByTheirHeadings) {
  const auto named = [](std::vector<std::string> voltages) {
    return BenchColumns{.hall = {}, .voltages = std::move(voltages), .between = {}, .interval_s = {}};
  };
  const std::string file = plain("time [s],u_ab [V],CH2 [V]\n");
  expect_right(file, 1e-5, named({"u_ab"}), 1);
  EXPECT_THAT(seen(file, named({"u_ab", "CH2"})).problem,
              HasSubstr("the headings do not tell between which points"));
}

/// A known column is not called unknown. The note states what the column is and which column is used instead.
TEST(RecordedDoubts, AKnownColumnThatIsNotUsedSaysTrulyWhy) {
  const auto notes = [](const std::string& more, const BenchColumns& columns = {}) {
    return seen(table("time [s],u_ab [V],u_bc [V]," + more + "\n",
                      [&](int, double t, double a, double b) {
                        std::string row = fmt::format("{:.6f},{:.5f},{:.5f}", t, a, b);
                        for (std::ptrdiff_t n = std::count(more.begin(), more.end(), ','); n >= 0; --n)
                          row += fmt::format(",{}", n % 2);
                        return row + "\n";
                      }),
                columns)
        .notes;
  };
  EXPECT_THAT(
      notes("u_a,u_b [V]"),
      ElementsAre("not used: u_a, u_b (a voltage of a terminal; the line-to-line voltages are used)"));
  EXPECT_THAT(
      notes("hall1,H2,code"),
      ElementsAre("not used: hall1, H2 (a Hall line, not a voltage), code (Hall codes, not a voltage)"));
  EXPECT_THAT(notes("i_a [A],speed"),
              ElementsAre("not used: i_a (in A), speed (its heading has no known meaning)"));
  EXPECT_THAT(notes("u_a [mA]"), ElementsAre("not used: u_a (in mA)"));
}

/// Any two of the three voltages suffice. None of these pairs reverses the direction of the motor.
TEST(RecordedDoubts, AnyTwoVoltagesOfThreeAreUsed) {
  for (const char* head : {"time [s],u_ab,u_bc\n", "time [s],u_bc,u_ca\n", "time [s],u_ca,u_ab\n"}) {
    const Seen found = seen(plain(head));
    ASSERT_EQ(found.problem, "") << head;
    EXPECT_EQ(found.notes.size(), 0u) << head;
    EXPECT_EQ(found.channels.size(), 2u) << head;
    EXPECT_FALSE(found.backward) << head;
    EXPECT_NEAR(found.line_peak_mV_s / right_mV_s, 1.0, 1e-5) << head;
  }
  // In this file, the order of the columns differs from the order of the phases.
  const Seen turned = seen(plain("time [s],u_ab,u_ca\n"));
  EXPECT_TRUE(turned.backward);
  EXPECT_THAT(turned.channels, ElementsAre("u_ca", "u_ab"));
  EXPECT_THAT(seen(plain("time [s],u_ca,x\n")).channels, ElementsAre("u_ca"));
}

TEST(RecordedDoubts, WhatIsAskedForDecidesBetweenVoltagesOfTwoKinds) {
  const std::string both = table("time [s],u_ab,u_a,u_b,u_c\n", [](int, double t, double a, double b) {
    const double k = 1.0 / std::sqrt(3.0);  // three voltages with the amplitude of the phases, 120 degrees
                                            // apart
    return fmt::format("{:.6f},{:.5f},{:.5f},{:.5f},{:.5f}\n", t, a, k * a, k * b, -k * (a + b));
  });
  BenchColumns star;
  star.between = analysis::EmfBetween::star;
  EXPECT_THAT(seen(both).channels, ElementsAre("u_a", "u_b", "u_c"));
  EXPECT_THAT(seen(both).notes,
              ElementsAre("not used: u_ab (a line-to-line voltage; the voltages of terminals are used)"));
  EXPECT_THAT(seen(both, star).channels, ElementsAre("u_a", "u_b", "u_c"));
  EXPECT_THAT(seen(both, between_lines).channels, ElementsAre("u_ab"));
  EXPECT_NEAR(seen(both).line_peak_mV_s, seen(both, between_lines).line_peak_mV_s, 1e-3);
  const std::string one_each = plain("time [s],u_ab,u_a\n");
  EXPECT_THAT(seen(one_each).channels, ElementsAre("u_ab"));
  EXPECT_THAT(seen(one_each, star).channels, ElementsAre("u_a"));
}

/// Without known headings, every column is a voltage, unless it is known to be something else.
TEST(RecordedDoubts, AHallLineIsTakenForNoVoltage) {
  const Seen found = seen(plain("time [s],CH1,hall1\n"), between_lines);
  EXPECT_THAT(found.channels, ElementsAre("CH1"));
  EXPECT_THAT(found.notes, ElementsAre("not used: hall1 (a Hall line, not a voltage)"));
}

TEST(RecordedDoubts, TwoColumnsOfOneNameAreToldApartByPlace) {
  const std::string file = plain("time [s],u_ab,u_ab\n");
  EXPECT_THAT(seen(file).problem,
              HasSubstr("has 2 columns \"u_ab\"; name one column by its number: column 2 or column 3"));
  const auto named = [](std::vector<std::string> voltages) {
    return BenchColumns{.hall = {},
                        .voltages = std::move(voltages),
                        .between = analysis::EmfBetween::lines,
                        .interval_s = {}};
  };
  EXPECT_THAT(seen(file, named({"u_ab"})).problem, HasSubstr("has 2 columns"));
  expect_right(file, 1e-5, named({"u_ab", "u_ab"}));
  expect_right(file, 1e-5, named({"column 2", "column 3"}));
  EXPECT_THAT(seen(plain("time [s],a,b\n"), named({"a", "a"})).problem,
              HasSubstr("is asked twice for the column \"a\""));
  EXPECT_THAT(seen(plain("time [s],CH1,CH1\n"), between_lines).channels,
              ElementsAre("CH1", "CH1 (column 3)"));
}

/// The rate in the preamble must agree with the time column.
TEST(RecordedDoubts, ARateInThePreamble) {
  const std::string rate = "# Samplerate: 10 kHz\n";
  expect_right(rate + plain("Time,u_ab,u_bc\n"));
  for (const auto& [per_s, unit] : {std::pair{1e3, "ms"}, {1e6, "us"}, {1e9, "ns"}}) {
    const std::string file = rate + plain("Time,u_ab,u_bc\n", "{:.1f},{:.5f},{:.5f}\n", per_s);
    expect_right(file);
    EXPECT_THAT(
        seen(file).notes,
        ElementsAre(fmt::format("Time is read in {}, because the file says \"Samplerate: 10 kHz\"", unit)));
  }
  expect_right(rate + table("u_ab,u_bc\n", [](int, double, double a, double b) {
                 return fmt::format("{:.5f},{:.5f}\n", a, b);
               }));
  for (const char* said : {"Samplerate: 10 kHz", "Sample Rate,1.0E+04", "Sampling rate: 10 kSa/s",
                           "Sample Interval,1e-4", "Delta_X: 0.1 ms", "Sample Interval,100,us"})
    expect_right(std::string(said) + "\n" + plain("Time,u_ab,u_bc\n", "{:.0f},{:.5f},{:.5f}\n", 1e6));
  for (const char* head : {"Time [s],u_ab,u_bc\n", "Time (ms),u_ab,u_bc\n"})
    EXPECT_THAT(seen(rate + plain(head, "{:.0f},{:.5f},{:.5f}\n", 1e6)).problem,
                HasSubstr("contradicts itself: Time rises by"))
        << head;
  EXPECT_THAT(seen("Samplerate: 1 kHz\n" + plain("Time [s],u_ab,u_bc\n")).problem,
              HasSubstr("contradicts itself"));
  // If the file contains every tenth sample of a faster acquisition, this is not a contradiction. It causes a
  // note.
  EXPECT_THAT(seen("Samplerate: 100 kHz\n" + plain("Time [s],u_ab,u_bc\n")).notes,
              ElementsAre(HasSubstr("rows are 0.0001 s apart")));
}

TEST(RecordedDoubts, WhatNoMotorHasIsRefused) {
  // The time column is in microseconds, but its heading says seconds, so 117 Hz become 117 uHz.
  EXPECT_THAT(seen(plain("time [s],u_ab,u_bc\n", "{:.0f},{:.5f},{:.5f}\n", 1e6)).problem,
              AllOf(HasSubstr("time gives the shaft 0.001 rpm with 7 pole pairs"),
                    HasSubstr("check the unit of time")));
  // The voltage columns are in millivolts, but their headings say kilovolts.
  EXPECT_THAT(seen(plain("time [s],u_ab [kV],u_bc [kV]\n", "{:.6f},{:.5f},{:.5f}\n", 1.0, 1e3)).problem,
              AllOf(HasSubstr("no brushless machine is built with more than 1e+06"),
                    HasSubstr("the voltage is too great")));
}

TEST(RecordedDoubts, ClippedNoisyAndTornRecordingsAreCalledSo) {
  const auto of = [](const std::function<double(int n, double u)>& value) {
    return table("time [s],u_ab\n", [&](int n, double t, double a, double) {
      return fmt::format("{:.6f},{:.5f}\n", t, value(n, a));
    });
  };
  EXPECT_THAT(seen(of([](int, double u) { return std::clamp(u, -2.6, 2.6); })).problem,
              HasSubstr("u_ab is clipped: the voltage stays at 2.6 or -2.6 V"));
  EXPECT_THAT(seen(of([](int n, double u) {
                return std::clamp(u + 0.01 * std::sin(7919.0 * n * n), -3.5, 9.0);
              })).problem,
              HasSubstr("is clipped"));
  EXPECT_THAT(seen(of([](int n, double) { return std::sin(7919.0 * n * n); })).problem,
              HasSubstr("u_ab has half waves of very different lengths"));
  EXPECT_THAT(seen(of([](int n, double u) { return 0.1 * u + std::sin(7919.0 * n * n); })).problem,
              HasSubstr("u_ab has half waves of very different lengths"));
  const std::string torn = table("time [s],u_ab\n", [](int n, double t, double, double) {
    const double at = n < 43 ? t : t + 1.0;
    return fmt::format("{:.6f},{:.5f}\n", at, u_ab(at));
  });
  EXPECT_THAT(seen(torn.substr(0, torn.find("\n1.010"))).problem, HasSubstr("is followed by a gap of 1 s"));
  // The flanks of a trapezoid are straight. Its flat tops must not be mistaken for clipping.
  const std::string trapezoid = table("time [s],u_a,u_b,u_c\n", [](int, double t, double, double) {
    const auto phase = [&](double lag) {
      const double x = std::fmod(w * t / (2.0 * std::numbers::pi) + 2.0 - lag, 1.0);
      return 2.0 *
             std::clamp(6.0 * (x < 0.5 ? std::min(x, 0.5 - x) : -std::min(x - 0.5, 1.0 - x)), -1.0, 1.0);
    };
    return fmt::format("{:.6f},{:.5f},{:.5f},{:.5f}\n", t, phase(0.0), phase(1.0 / 3.0), phase(2.0 / 3.0));
  });
  EXPECT_EQ(seen(trapezoid).problem, "");
}

}  // namespace SIXSTEP_TEST_FILE
}  // namespace text

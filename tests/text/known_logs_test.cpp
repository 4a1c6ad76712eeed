// SPDX-License-Identifier: Apache-2.0
// The logs of drive programs are recognised by their headings and converted to a trace in SI units. Damaged
// logs, and logs of several drives, are refused with advice.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <functional>

#include "sixstep/base/angle.hpp"
#include "text/recording/board_log.hpp"

namespace SIXSTEP_TEST_FILE {

using sixstep::base::pi;
using ::testing::HasSubstr;

constexpr int pairs = 7;

/// A drive that accelerates. Each log contains its values in the log's own units.
struct Row {
  double t_s, speed_rad_s, bus_V, i_d_A, i_q_A;
};
std::vector<Row> rows() {
  std::vector<Row> out;
  for (int n = 0; n < 8; ++n) out.push_back({0.01 * n, 5.0 * n, 24.0 - 0.125 * n, -0.25 * n, 2.0 + n});
  return out;
}

std::string log_of(const std::string& head, const std::function<std::string(const Row&)>& line) {
  std::string text = head;
  for (const Row& row : rows()) text += line(row);
  return text;
}

double erpm(const Row& r) { return r.speed_rad_s * pairs * 30 / pi; }

std::string vesc() {
  return log_of(
      "ms_today;input_voltage;temp_mos_max;current_motor;current_in;d_axis_current;q_axis_current;erpm;duty_cycle;\n",
      [](const Row& r) {
        return fmt::format("{:.0f};{};31.2;{};0.5;{};{};{:.9f};0.4;\n", 36'000'000 + 1e3 * r.t_s, r.bus_V,
                           r.i_q_A, r.i_d_A, r.i_q_A, erpm(r));
      });
}
std::string ardupilot(int escs) {
  return log_of(
      "timestamp,TimeUS,Instance,RPM,RawRPM,Volt,Curr,Temp,CTot,MotTemp,Err\n", [escs](const Row& r) {
        std::string text;
        for (int n = 0; n < escs; ++n)
          text += fmt::format("{},{:.0f},{},{:.9f},0,{},3,31,0,0,0\n", 1.7e9 + r.t_s,
                              1e6 * (r.t_s + 1e-3 * n), n, r.speed_rad_s * 30 / pi * (n + 1), r.bus_V);
        return text;
      });
}
std::string blackbox(const std::string& motors) {
  return log_of("loopIteration, time (us), axisP[0], " + motors + "vbatLatest (V), amperageLatest (A)\n",
                [&motors](const Row& r) {
                  std::string text = fmt::format("{:.0f}, {:.0f}, 0, ", 1e5 * r.t_s, 5e6 + 1e6 * r.t_s);
                  for (std::size_t n = 1, at = motors.find(','); at != std::string::npos;
                       at = motors.find(',', at + 1), ++n)
                    text += fmt::format("{:.9f}, ", static_cast<double>(n) * erpm(r) / 100);
                  return text + fmt::format("{}, 3\n", r.bus_V);
                });
}
std::string odrive() {
  return log_of("time [s],vel_estimate,Iq_measured,Id_measured,vbus_voltage,ibus\n", [](const Row& r) {
    return fmt::format("{},{:.12f},{},{},{},1\n", r.t_s, r.speed_rad_s / (2 * pi), r.i_q_A, r.i_d_A, r.bus_V);
  });
}
std::string moteus() {
  return log_of("time,MODE,POSITION,VELOCITY,TORQUE,Q_CURRENT,D_CURRENT,VOLTAGE,TEMPERATURE,FAULT\n",
                [](const Row& r) {
                  return fmt::format("{},10,0.1,{:.12f},0.1,{},{},{},30,0\n", r.t_s, r.speed_rad_s / (2 * pi),
                                     r.i_q_A, r.i_d_A, r.bus_V);
                });
}
std::string servo_stats() {
  return log_of("timestamp,bus_V,d_A,fault,position,q_A,torque_Nm,velocity\n", [](const Row& r) {
    return fmt::format("{:.3f},{},{},0,0.1,{},0.1,{:.12f}\n", 1'700'000'000 + r.t_s, r.bus_V, r.i_d_A,
                       r.i_q_A, r.speed_rad_s / (2 * pi));
  });
}
std::string simple_foc() {
  return log_of("MOT: Monitor enabled!\nMOT: Ready.\n", [](const Row& r) {
    return fmt::format("5.0\t1.5\t0.0\t{}\t{}\t{}\t0.1\n", 1e3 * r.i_q_A, 1e3 * r.i_d_A, r.speed_rad_s);
  });
}

text::LogColumns wanted(bool field = true, std::optional<int> esc = {},
                        std::optional<double> interval_s = {}) {
  return {.formulas = {}, .interval_s = interval_s, .pole_pairs = pairs, .field_oriented = field, .esc = esc};
}

/// The values of the column. Empty if the log has no such column.
std::vector<double> column(const text::BoardLog& log, const std::string& name) {
  for (std::size_t n = 0; n < log.trace.columns.size(); ++n)
    if (log.trace.columns[n].name == name) return log.trace.values[n];
  return {};
}

/// Expects the values of rows(), times a factor.
void expect_values(const text::BoardLog& log, const std::string& name, double Row::*member,
                   double factor = 1.0) {
  const std::vector<double> found = column(log, name);
  ASSERT_EQ(found.size(), rows().size()) << name;
  for (std::size_t n = 0; n < found.size(); ++n)
    EXPECT_NEAR(found[n], factor * rows()[n].*member, 1e-8) << name << " in row " << n;
}

void expect_log(const std::string& name, const std::string& bytes, const text::LogColumns& as,
                bool currents) {
  SCOPED_TRACE(name);
  const auto log = text::read_board_log("a.csv", bytes, as);
  ASSERT_TRUE(log) << to_string(log.problems()[0]);
  EXPECT_THAT(log->recognised, HasSubstr(name + ": "));
  expect_values(*log, "speed_rad_s", &Row::speed_rad_s);
  if (name != "a SimpleFOC monitor log") expect_values(*log, "bus_V", &Row::bus_V);
  if (currents) expect_values(*log, "i_d_A", &Row::i_d_A);
  if (currents) expect_values(*log, "i_q_A", &Row::i_q_A);
  const std::vector<double>& t = log->trace.values[0];
  for (std::size_t n = 1; n < t.size(); ++n) EXPECT_NEAR(t[n] - t[n - 1], 0.01, 1e-6);
}

TEST(KnownLogs, AreRecognisedAndConverted) {
  expect_log("a VESC Tool log", vesc(), wanted(), true);
  expect_log("an ArduPilot ESC log", ardupilot(1), wanted(), false);
  expect_log("a Betaflight log of blackbox_decode", blackbox("eRPM[0], "), wanted(), false);
  expect_log("a log with the names of ODrive's properties", odrive(), wanted(), true);
  expect_log("a log of moteus registers", moteus(), wanted(), true);
  expect_log("a log of moteus servo_stats", servo_stats(), wanted(), true);
  expect_log("a SimpleFOC monitor log", simple_foc(), wanted(true, {}, 0.01), true);
}

TEST(KnownLogs, ADriveInBlocksComparesTheCurrentOfThePair) {
  const auto log = text::read_board_log("a.csv", vesc(), wanted(false));
  ASSERT_TRUE(log);
  expect_values(*log, "i_m_A", &Row::i_q_A);
  EXPECT_TRUE(column(*log, "i_q_A").empty());
  EXPECT_EQ(column(*log, "duty").size(), rows().size());
  EXPECT_TRUE(column(*text::read_board_log("a.csv", vesc(), wanted()), "i_m_A").empty());
}

TEST(KnownLogs, ColumnsOfAnotherMeaningAreNamedWithTheReason) {
  const auto log = text::read_board_log("a.csv", vesc(), wanted(false));
  ASSERT_TRUE(log);
  std::string text;
  for (const text::NotUsed& column : log->not_used) text += column.column + ": " + column.reason + "\n";
  EXPECT_THAT(text, HasSubstr("current_in: a mean over PWM periods"));
  EXPECT_THAT(
      text,
      HasSubstr(
          "q_axis_current: a value of the rotor's d or q axis; the simulated drive is a six-step drive"));
}

TEST(KnownLogs, OfSeveralDrivesOneIsChosen) {
  const auto told = [](const std::string& bytes, std::optional<int> esc) {
    const auto log = text::read_board_log("a.csv", bytes, wanted(true, esc));
    return log ? log->recognised : to_string(log.problems()[0]);
  };
  EXPECT_EQ(told(ardupilot(3), {}), "esc is missing: a.csv has rows of 3 ESCs; choose one: 0, 1, 2");
  EXPECT_EQ(told(ardupilot(3), 5), "esc 5 is no ESC of a.csv; choose one: 0, 1, 2");
  EXPECT_EQ(told(blackbox("eRPM[0], eRPM[1], "), {}), "esc is missing: a.csv has 2 motors; choose one: 0, 1");
  EXPECT_EQ(told(blackbox("eRPM[0], eRPM[1], "), 2), "esc 2 is no motor of a.csv; choose one: 0, 1");
  EXPECT_THAT(told(vesc(), 0), HasSubstr("esc has no effect, because a.csv is not a log of several ESCs"));
  for (const int n : {0, 2}) {
    const auto log = text::read_board_log("a.csv", ardupilot(3), wanted(true, n));
    ASSERT_TRUE(log) << to_string(log.problems()[0]);
    expect_values(*log, "speed_rad_s", &Row::speed_rad_s, n + 1);
  }
  std::string other = ardupilot(3);
  other.replace(other.find(",0,24,3"), 7, ",0,xx,3");  // a bad cell of ESC 0
  EXPECT_THAT(told(other, 0), HasSubstr("is not a number"));
  EXPECT_THAT(told(other, 1), HasSubstr("an ArduPilot ESC log: "));
  // There are so many bad cells that the reader stores the text of only the first cells.
  for (const std::string volts : {",0,24,3", ",0,23."})
    for (std::size_t at = other.find(volts); at != std::string::npos; at = other.find(volts))
      other.replace(at, 6, ",0,xxx");
  EXPECT_THAT(told(other, 2), HasSubstr("is not a number"));
  const auto second = text::read_board_log("a.csv", blackbox("eRPM[0], eRPM[1], "), wanted(true, 1));
  ASSERT_TRUE(second) << to_string(second.problems()[0]);
  expect_values(*second, "speed_rad_s", &Row::speed_rad_s, 2.0);
}

TEST(KnownLogs, FormulasOfTheUserWin) {
  text::LogColumns named = wanted();
  named.formulas = {"time=ms_today/1000", "bus_V=temp_mos_max"};
  const auto log = text::read_board_log("a.csv", vesc(), named);
  ASSERT_TRUE(log);
  EXPECT_EQ(log->recognised, "");
  EXPECT_EQ(column(*log, "bus_V").front(), 31.2);
}

/// Replaces a text once.
std::string with(std::string text, const std::string& from, const std::string& to) {
  const std::size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return at == std::string::npos ? text : text.replace(at, from.size(), to);
}

TEST(KnownLogs, HostileSistersAreRefused) {
  const auto told = [](const std::string& bytes, std::optional<double> interval_s = {}) {
    const auto log = text::read_board_log("a.csv", bytes, wanted(true, {}, interval_s));
    return log ? "a log of " + std::to_string(log->trace.values[0].size()) + " rows"
               : to_string(log.problems()[0]);
  };
  // The value is not a number, or a number that no instrument shows, or the clock jumps back at midnight.
  EXPECT_THAT(told(with(vesc(), ";24;", ";nan;")), HasSubstr("is not a number"));
  EXPECT_THAT(told(with(ardupilot(1), "0,0.000000000", "0,1e300")), HasSubstr("too large"));
  EXPECT_THAT(told(with(vesc(), "36000030", "30")), HasSubstr("does not rise"));
  EXPECT_THAT(told(with(moteus(), ",24,30,0", ",xx,30,0")), HasSubstr("is not a number"));
  EXPECT_THAT(told(with(servo_stats(), "1700000000.010", "1600000000.010")), HasSubstr("does not rise"));
  EXPECT_THAT(told(with(odrive(), "0.795774715459", "ERR")), HasSubstr("is not a number"));
  // The heading of a known column contains a unit of another kind.
  EXPECT_THAT(told(with(blackbox("eRPM[0], "), "vbatLatest (V)", "vbatLatest (A)")),
              HasSubstr("but V is expected"));
  // Columns are missing.
  EXPECT_THAT(told(blackbox("")), HasSubstr("is a Betaflight log without eRPM; turn on bidirectional DShot"));
  EXPECT_THAT(told(with(vesc(), "ms_today", "clock")), HasSubstr("has no column of time"));
  EXPECT_THAT(told(simple_foc()),
              HasSubstr("is a SimpleFOC monitor log, which has no time; give the interval of the rows"));
  // No known set of SimpleFOC's columns has five columns.
  EXPECT_THAT(told("MOT: Ready.\n1\t2\t3\t4\t5\n1\t2\t3\t4\t5\n", 0.01), testing::Not(HasSubstr("a log of")));
  // If the file is cut off, the incomplete last row does not count. A binary file contains no table.
  EXPECT_EQ(told(vesc().substr(0, vesc().size() - 20)), "a log of 7 rows");
  EXPECT_THAT(told("ms_today;input_voltage;erpm;\n" + std::string("\0\1\2\xff;\0;\3\n", 8)),
              testing::Not(HasSubstr("a log of")));
}

}  // namespace SIXSTEP_TEST_FILE

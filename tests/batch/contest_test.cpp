// SPDX-License-Identifier: Apache-2.0
// The results of a comparison of controllers obey physical laws, for any number of threads.
#include "batch/contest.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <mutex>

#include "sixstep/design/loops/field_current.hpp"
#include "text/contest/contest_entries.hpp"

namespace SIXSTEP_TEST_FILE {

using namespace sixstep;
using analysis::Contest;
using analysis::ContestRow;
using analysis::Gauge;

constexpr analysis::Contestant few[] = {
    {analysis::six_step_name, "", "is the reference"},
    {"six-step, complementary", "pwm.chopping = complementary", "chops the lower switch too"},
    {analysis::field_name, "control.drive = field-oriented", "turns a vector"}};

Contest compared(const std::string& motor, std::size_t drives, unsigned jobs) {
  const auto sheet = text::read_sheet(motor);
  EXPECT_TRUE(sheet);
  auto bench = analysis::contest_bench({.motor = motor, .sheet = *sheet});
  EXPECT_TRUE(bench);
  auto entries = text::contest_entries(*bench, {}, few);
  const batch::ContestOrder order{.drives = drives, .jobs = jobs};
  Contest contest = batch::compare_nominally(std::move(*bench), std::move(entries), order);
  std::mutex guard;
  std::vector<analysis::RunRecord> records;
  batch::run_drives(contest, order, {}, [&](analysis::RunRecord&& record) {
    const std::lock_guard lock(guard);
    records.push_back(std::move(record));
  });
  for (const analysis::RunRecord& record : records) analysis::take_drive(contest, record);
  return contest;
}

double gauge(const ContestRow& row, Gauge g) {
  return analysis::gauges_of(*row.nominal)[static_cast<std::size_t>(g)];
}

/// A sine machine with sine currents has the torque T = 3/2 p psi I and the copper loss 3/2 R I^2 (symbols of
/// model.md). Ripple and PWM increase the loss. Six-step control has at least the loss 2 R i^2 of its best
/// current i, with T = K_t i.
TEST(Contest, CopperLossIsThatOfTheTorque) {
  const Contest c = compared("teknic-m2310p", 0, 2);
  const design::MotorModel& m = c.bench.design.motor;
  const ContestRow &six = c.rows[0], &field = c.rows[2];
  const double sine_A = gauge(field, Gauge::mean_torque) /
                        design::torque_per_q_A(design::field_machine(m, c.bench.scenario.sheet));
  const double sine_W = 1.5 * m.machine.R_ohm * sine_A * sine_A;
  EXPECT_GE(gauge(field, Gauge::copper), sine_W);
  const double thd = gauge(field, Gauge::distortion);
  EXPECT_LE(gauge(field, Gauge::copper),
            1.01 * sine_W * (1 + thd * thd));  // harmonics cause heat but no mean torque
  const double pair_A = gauge(six, Gauge::mean_torque) / m.K_t_Nm_A;
  EXPECT_GE(gauge(six, Gauge::copper), 2 * m.machine.R_ohm * pair_A * pair_A);
}

/// For both controllers, the mean torque is the sum of the same load and the same friction.
TEST(Contest, TheMeanTorqueIsTheLoads) {
  const Contest c = compared("maxon-251601", 0, 2);
  const double load =
      c.bench.course.load_Nm / 2 + c.bench.design.motor.shaft.B_Nm_s * c.bench.course.high_rad_s;
  for (const ContestRow& row : c.rows) {
    ASSERT_TRUE(row.nominal_held);
    EXPECT_NEAR(gauge(row, Gauge::mean_torque), load, 0.005 * load);
  }
}

/// Freewheeling through a switch of 11 mohm has lower losses than through a diode of 0.8 V.
TEST(Contest, ComplementaryChoppingSparesTheDiode) {
  const Contest c = compared("maxon-251601", 0, 2);
  EXPECT_LT(gauge(c.rows[1], Gauge::conduction), 0.5 * gauge(c.rows[0], Gauge::conduction));
}

/// In this test, each controller runs well at the course's low speed. Half of this speed, half of the half,
/// and so on are tried to find the lowest speed.
TEST(Contest, TheLowestSpeedIsAHalvingOfTheCoursesLowOne) {
  const Contest c = compared("maxon-251601", 0, 2);
  const std::vector<double> speeds = analysis::slow_speeds(c.bench.course);
  ASSERT_EQ(speeds.size(), 6U);
  for (const ContestRow& row : c.rows) {
    ASSERT_TRUE(row.lowest_rad_s);
    EXPECT_NE(std::find(speeds.begin(), speeds.end(), *row.lowest_rad_s), speeds.end());
  }
}

TEST(Contest, TheLowestSpeedIsThatDownToWhichAllAreHeld) {
  analysis::Course course;
  course.slow_rad_s = 64.0;
  std::vector<study::Verdict> verdicts(18);
  EXPECT_FALSE(analysis::lowest_speed_rad_s(course, verdicts));
  for (std::size_t n = 0; n < 6; ++n) verdicts[n].ok = true;
  EXPECT_EQ(analysis::lowest_speed_rad_s(course, verdicts), 32.0);
  for (std::size_t n = 9; n < 18; ++n)
    verdicts[n].ok = true;  // 16 rad/s was not held, so speeds tested
                            // later are ignored
  EXPECT_EQ(analysis::lowest_speed_rad_s(course, verdicts), 32.0);
  for (study::Verdict& v : verdicts) v.ok = true;
  EXPECT_EQ(analysis::lowest_speed_rad_s(course, verdicts), 2.0);
}

TEST(Contest, DrivesAreTheSameOnAnyNumberOfThreadsAndNoneIsBetterThanTheWorst) {
  const Contest a = compared("maxon-251601", 2, 1), b = compared("maxon-251601", 2, 3);
  for (std::size_t n = 0; n < a.rows.size(); ++n) {
    EXPECT_EQ((*a.rows[n].nominal)->digest, (*b.rows[n].nominal)->digest);
    EXPECT_EQ(a.rows[n].worst, b.rows[n].worst);
    EXPECT_EQ(a.rows[n].drives, 2U);
    for (std::size_t f = 0; f < a.rows[n].values.size(); ++f)
      EXPECT_GE((*a.rows[n].worst)[f], a.rows[n].values[f]);
    EXPECT_GT(a.rows[n].trace.t_s.size(), 500U);
    EXPECT_EQ(a.rows[n].trace.t_s.size(), a.rows[n].trace.speed_rad_s.size());
  }
}

}  // namespace SIXSTEP_TEST_FILE

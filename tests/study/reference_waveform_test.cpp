// SPDX-License-Identifier: Apache-2.0
// The controller's value of a reference that changes over time. At each tick, it is compared with the closed
// form.
#include "sixstep/study/scenario/reference_waveform.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "sixstep/control/profile.hpp"
#include "tests/support/scenarios.hpp"

namespace SIXSTEP_TEST_FILE {

using namespace sixstep;
using namespace sixstep::testing;
using control::Mode;
using study::Reference;
using study::Scenario;
using study::Shape;
using study::Stretch;

Scenario with(const Reference& reference, double duration_s = 10.0) {
  Scenario s;
  s.duration_s = duration_s;
  s.reference = reference;
  return s;
}

double at(const std::vector<Stretch>& stretches, double t_s) {
  std::size_t n = 0;
  while (n + 1 < stretches.size() && stretches[n + 1].at_s <= t_s) ++n;
  return stretches[n].at(t_s);
}

/// Expects that each section begins at the end of the section before it. The tolerance is the rounding of a
/// few products of the size of `way`.
void expect_no_jump(const std::vector<Stretch>& stretches, double way) {
  for (std::size_t n = 0; n + 1 < stretches.size(); ++n)
    EXPECT_NEAR(stretches[n].at(stretches[n + 1].at_s), stretches[n + 1].value, 8 * 0x1p-52 * way) << n;
}

TEST(ReferenceCourse, ARampIsALineFromStartToEnd) {
  const Reference by_time{.shape = Shape::ramp, .begin_s = 0.5, .start = 2.0, .end = -8.0, .end_s = 4.5};
  Reference by_slope = by_time;
  by_slope.end_s.reset();
  by_slope.slope = 2.5;
  for (const Reference& r : {by_time, by_slope}) {
    const std::vector<Stretch> stretches = reference_waveform(with(r));
    expect_no_jump(stretches, 10.0);
    EXPECT_EQ(at(stretches, 0.25), 2.0);
    EXPECT_EQ(at(stretches, 1.5), -0.5);
    EXPECT_EQ(at(stretches, 4.5), -8.0);
    EXPECT_EQ(at(stretches, 9.0), -8.0);
  }
}

TEST(ReferenceCourse, ASineCountsItsTurns) {
  const std::vector<Stretch> stretches = reference_waveform(with(
      {.shape = Shape::sine, .offset = 1.0, .amplitude = 3.0, .frequency_Hz = 1000.0, .phase_deg = 90.0}));
  ASSERT_EQ(stretches.size(), 1u);
  EXPECT_EQ(stretches[0].at(0.0), 4.0);
  // A time of 1e9 periods later gives the same bits, because 1000 Hz times 1e6 s is a whole number.
  EXPECT_EQ(stretches[0].at(1e6), stretches[0].at(0.0));
  for (const double t : {1e-4, 3.3e-4, 7.7e-4})
    EXPECT_NEAR(stretches[0].at(t), 1.0 + 3.0 * std::cos(2 * M_PI * 1000.0 * t), 8 * 0x1p-52 * 4.0);
}

TEST(ReferenceCourse, ATrapezoidKeepsRateAndAcceleration) {
  // A move of 90 degrees at 30 deg/s and 60 deg/s^2: 0.5 s of acceleration over 7.5 degrees, 2.5 s at
  // constant speed, 0.5 s of deceleration.
  const Reference far{
      .shape = Shape::trapezoid, .begin_s = 1.0, .end = 90.0, .slope = 30, .acceleration = 60};
  const std::vector<Stretch> stretches = reference_waveform(with(far));
  expect_no_jump(stretches, 90.0);
  EXPECT_EQ(at(stretches, 1.0), 0.0);
  EXPECT_EQ(at(stretches, 1.5), 7.5);
  EXPECT_EQ(at(stretches, 2.75), 45.0);
  EXPECT_EQ(at(stretches, 4.0), 82.5);
  EXPECT_EQ(at(stretches, 4.5), 90.0);
  EXPECT_EQ(at(stretches, 9.0), 90.0);
  // A move of 3.75 degrees in the other direction: 0.25 s of acceleration to 15 deg/s, and 0.25 s of
  // deceleration. It does not reach 30 deg/s.
  Reference near = far;
  near.end = -3.75;
  const std::vector<Stretch> there = reference_waveform(with(near));
  expect_no_jump(there, 3.75);
  EXPECT_EQ(at(there, 1.25), -1.875);
  EXPECT_EQ(at(there, 1.5), -3.75);
  EXPECT_NEAR(there[1].at(1.25 + 1e-3) - there[1].at(1.25), -0.015 - 0.5 * 60 * 1e-6, 8 * 0x1p-52 * 3.75)
      << "15 deg/s, still rising";
}

TEST(ReferenceCourse, TheChipsOwnProfileOfTheSameLimitsIsThereNoLater) {
  // The profile of control/profile.hpp moves in whole ticks. Its documentation states that it is at least as
  // fast as the continuous profile.
  const double T = 1e-3;
  for (const double way : {0.001, 0.37, 3.75, 12.0, 90.0}) {
    const std::vector<Stretch> stretches =
        reference_waveform(with({.shape = Shape::trapezoid, .end = way, .slope = 30, .acceleration = 60}));
    const control::ProfileConfig<double> config{30 * T, 60 * T * T};
    control::ProfileState<double> state;
    int ticks = 0;
    while (state.position != way && ticks < 100000) {
      control::profile_step(config, state, way);
      ++ticks;
    }
    EXPECT_LE(ticks * T, stretches.back().at_s + T) << way;
    EXPECT_GE(ticks * T, stretches.back().at_s - 2 * T) << way;
  }
}

TEST(ReferenceCourse, RowsAreJoinedOrHeldAndRunOnAtBothEnds) {
  Reference r{.shape = Shape::csv, .times_s = {1.0, 2.0, 4.0}, .values = {5.0, 7.0, 1.0}};
  std::vector<Stretch> stretches = reference_waveform(with(r));
  EXPECT_EQ(at(stretches, 0.0), 5.0);
  EXPECT_EQ(at(stretches, 1.5), 6.0);
  EXPECT_EQ(at(stretches, 3.0), 4.0);
  EXPECT_EQ(at(stretches, 9.0), 1.0);
  EXPECT_TRUE(reference_moves(with(r), 3.0, 3.5));
  EXPECT_FALSE(reference_moves(with(r), 4.0, 9.0));
  r.interpolation = study::Interpolation::hold;
  stretches = reference_waveform(with(r));
  EXPECT_EQ(at(stretches, 1.5), 5.0);
  EXPECT_EQ(at(stretches, 3.9), 7.0);
  EXPECT_FALSE(reference_moves(with(r), 0.0, 9.0));
}

TEST(ReferenceCourse, RestsWhereItsLastWayEnds) {
  const auto rests = [](const Reference& r) { return reference_rests_from_s(with(r)); };
  const Reference ramp{.shape = Shape::ramp, .begin_s = 1.0, .end = 6.0, .slope = 0.5};
  EXPECT_EQ(rests(ramp), 13.0) << "behind the run's end, which is 10 s";
  EXPECT_EQ(rests({.shape = Shape::csv, .times_s = {1.0, 12.0}, .values = {5.0, 7.0}}), 12.0);
  EXPECT_EQ(rests({.shape = Shape::steps, .times_s = {0.0, 9.0}, .values = {5.0, 7.0}}), 0.0);
  EXPECT_EQ(rests({.shape = Shape::square, .high = 4.0, .low = -4.0, .period_s = 1e-3}), 0.0);
  EXPECT_EQ(rests({.shape = Shape::sine, .amplitude = 1.0, .frequency_Hz = 1.0}), std::nullopt);
  // The last reference determines the result. Of the reference before it, only the value at the change has an
  // effect.
  Scenario s = with({.shape = Shape::sine, .amplitude = 1.0, .frequency_Hz = 1.0});
  s.at.push_back({.time_s = 5.0, .reference = Reference{.value = 1.0}});
  EXPECT_EQ(reference_rests_from_s(s), 5.0);
  s.at.push_back({.time_s = 6.0, .reference = ramp});
  EXPECT_EQ(reference_rests_from_s(s), 17.0);
}

TEST(ReferenceCourse, AnEventTakesOverWhereTheReferenceStood) {
  Scenario s = with({.shape = Shape::square, .high = 4.0, .low = -4.0, .period_s = 2.0});
  // The times of the new reference count from the event. This reference replaces the rest of the square.
  s.at.push_back({.time_s = 5.5, .reference = Reference{.shape = Shape::ramp, .end = 6.0, .slope = 5.0}});
  s.at.push_back({.time_s = 8.0, .reference = Reference{.value = 1.0}});
  const std::vector<Stretch> stretches = reference_waveform(s);
  EXPECT_EQ(at(stretches, 5.4), -4.0);
  EXPECT_EQ(at(stretches, 6.5), 1.0);
  EXPECT_EQ(at(stretches, 7.9), 6.0);
  EXPECT_EQ(at(stretches, 9.0), 1.0);
  EXPECT_EQ(largest_reference(s), 6.0);
  // If a run ends during a ramp, the largest reference is the largest value that was reached.
  s.at.pop_back();
  s.duration_s = 6.5;
  EXPECT_EQ(largest_reference(s), 4.0);
}

/// Records the column `column`, with `parts` rows in each PWM period.
std::vector<double> recorded(Scenario s, const char* column, int parts = 1) {
  s.record.grid_s = s.pwm.period_s / parts;
  s.record.columns = {column};
  std::vector<double> seen;
  const auto out = study::run(s, {.on_record = [&](study::Row row) { seen.push_back(row[1]); }});
  EXPECT_TRUE(out) << to_string(out.problems().at(0));
  return seen;
}

/// The value in the middle of each period. It is constant from the tick of the period on.
std::vector<double> held(const Scenario& s, const char* column) {
  const std::vector<double> rows = recorded(s, column, 2);
  std::vector<double> middles;
  for (std::size_t n = 1; n < rows.size(); n += 2) middles.push_back(rows[n]);
  return middles;
}

TEST(ReferenceCourse, TheControllerSeesTheClosedFormAtItsTicks) {
  Scenario s = current_square();
  s.reference = {.shape = Shape::sine, .offset = 1.0, .amplitude = 3.0, .frequency_Hz = 333.0};
  s.at.push_back(
      {.time_s = 7e-3,
       .reference = Reference{.shape = Shape::trapezoid, .end = -2.0, .slope = 900.0, .acceleration = 6e5}});
  const std::vector<Stretch> stretches = reference_waveform(s);
  const std::vector<double> wide = held(s, "i_ref_A");
  s.control.arithmetic = study::Arithmetic::float32;
  const std::vector<double> narrow = held(s, "i_ref_A");
  s.control.arithmetic = study::Arithmetic::q31;
  const std::vector<double> fixed = held(s, "i_ref_A");
  ASSERT_EQ(wide.size(), 667u);
  for (std::size_t n = 0; n < wide.size(); ++n) {
    const double expected = at(stretches, static_cast<double>(n) * 30'000'000 / 1e12);
    // The rig's clock resolves the time since the start of the section to a picosecond.
    EXPECT_NEAR(wide[n], expected, 2 * 3.0 * 2 * M_PI * 333.0 * 1e-12) << n;
    EXPECT_EQ(narrow[n], static_cast<double>(static_cast<float>(wide[n]))) << n;
    EXPECT_NEAR(fixed[n], wide[n], 8.0 * 0x1p-31) << n << ": one digit of at most 8 A full scale";
  }
}

TEST(ReferenceCourse, EventComparatorsFollowItFromTickToTick) {
  Scenario s = current_square();
  s.control.current = {.type = study::CurrentLoopType::hysteresis};
  s.reference = {.shape = Shape::ramp, .begin_s = 1e-3 + 1e-6, .start = 2.0, .end = 5.0, .end_s = 12e-3};
  const std::vector<Stretch> stretches = reference_waveform(s);
  const std::vector<double> seen = held(s, "i_ref_A");
  // The step at the start of the ramp is between two ticks and acts at once. Then the ramp acts at each tick.
  // The time since its start is accurate to a picosecond.
  for (std::size_t n = 0; n < seen.size(); ++n)
    EXPECT_NEAR(seen[n], at(stretches, static_cast<double>(n) * 30'000'000 / 1e12), 2 * 3.0 / 11e-3 * 1e-12)
        << n;
}

TEST(ReferenceCourse, ARampOutOfAFullDutyIsSeenThoughItsTicksWereSkipped) {
  Scenario s = maxon_scenario(Mode::duty, 0.0);
  s.reference = {.shape = Shape::ramp, .begin_s = 9.005e-3, .start = 1.0, .end = 0.0, .end_s = 19.005e-3};
  const std::vector<double> duty = held(s, "duty");
  for (std::size_t n = 0; n + 40 < duty.size(); ++n) {
    const double t = static_cast<double>(n) * 30e-6;
    EXPECT_NEAR(duty[n], t < 9.005e-3 ? 1.0 : 1.0 - (t - 9.005e-3) / 10e-3, 2 * 100 * 1e-12) << n;
  }
}

TEST(ReferenceCourse, ADutyRampDrivesTheHeldMotorAsTheSamplesSay) {
  // The rotor is locked, and the current starts at zero with soft chopping. In a period with the duty d, the
  // source phase is on for d T; then the current freewheels. The chip's duty is constant between two ticks.
  Scenario s = maxon_scenario(Mode::duty, 0.0);
  s.load.locked = true;
  s.initial.angle_rad = 0.02;
  s.reference = {.shape = Shape::ramp, .end = 0.9, .end_s = 18e-3};
  const std::vector<double> i = recorded(s, "i_m_A");
  const double T = 30e-6, tau = 0.572e-3 / 1.03, stall = 24.0 / 1.03;
  double expected = 0.0;
  for (std::size_t n = 0; n < i.size(); ++n) {
    EXPECT_NEAR(i[n], expected, 1e-12 * stall) << n;
    const double d = std::min(0.9, 0.9 * (static_cast<double>(n) * T) / 18e-3);
    const double top = stall + (expected - stall) * std::exp(-d * T / tau);
    expected = top * std::exp(-(1 - d) * T / tau);
  }
}

}  // namespace SIXSTEP_TEST_FILE

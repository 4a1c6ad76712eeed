// SPDX-License-Identifier: Apache-2.0
#include "sixstep/control/faults.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "sixstep/control/state_machine.hpp"
#include "tests/control/scalars.hpp"

namespace SIXSTEP_TEST_FILE {

using namespace sixstep::control;

static_assert(std::is_trivially_copyable_v<FaultState> && std::is_trivially_copyable_v<ActivityState>);

template <class Scalar>
class Faults : public ::testing::Test {
 public:
  FaultConfig<Scalar> config{.over_current_A = Scalar(0.8),
                             .over_voltage_V = Scalar(0.9),
                             .under_voltage_V = Scalar(0.3),
                             .over_speed_rad_s = Scalar(0.7),
                             .stall_current_A = Scalar(0.4),
                             .stall_ticks = 5,
                             .voltage_ticks = 3};
  Measurement<Scalar> good{
      .i_a_A = Scalar(0.5), .i_b_A = Scalar(-0.5), .speed_rad_s = Scalar(0.2), .bus_V = Scalar(0.5)};
  FaultState state;
  std::uint16_t tick(const Measurement<Scalar>& m, const FaultEvents& events = {.moved = true}) {
    return fault_step(config, state, m, events);
  }
};
TYPED_TEST_SUITE(Faults, Scalars);

TYPED_TEST(Faults, EachCauseIsNamedLatchedAndClearedOnlyWhenGone) {
  using S = TypeParam;
  struct Case {
    Measurement<S> m;
    Fault reason;
    int ticks;
  };
  Measurement<S> a = this->good, b = a, c = a, over = a, under = a, fast = a, back = a;
  a.i_a_A = S(0.9), b.i_b_A = S(-0.9), c.i_c_A = S(0.9);
  over.bus_V = S(0.95), under.bus_V = S(0.25);
  fast.speed_rad_s = S(0.75), back.speed_rad_s = S(-0.75);
  for (const Case& x :
       {Case{a, fault_over_current, 1}, Case{b, fault_over_current, 1}, Case{c, fault_over_current, 1},
        Case{over, fault_over_voltage, 3}, Case{under, fault_under_voltage, 3},
        Case{fast, fault_over_speed, 1}, Case{back, fault_over_speed, 1}}) {
    this->state = {};
    EXPECT_EQ(this->tick(this->good), fault_none);
    for (int n = 1; n < x.ticks; ++n) EXPECT_EQ(this->tick(x.m), fault_none);
    EXPECT_EQ(this->tick(x.m), x.reason);
    EXPECT_EQ(this->state.first, x.reason);
    EXPECT_FALSE(fault_clear(this->state)) << "the cause is still there";
    EXPECT_EQ(this->tick(this->good), x.reason) << "latched";
    EXPECT_TRUE(fault_clear(this->state));
    EXPECT_EQ(this->tick(this->good), fault_none);
  }
}

TYPED_TEST(Faults, AtTheThresholdNothingTrips) {
  using S = TypeParam;
  Measurement<S> m = this->good;
  m.i_a_A = S(0.8), m.i_b_A = S(-0.8), m.bus_V = S(0.9), m.speed_rad_s = S(-0.7);
  EXPECT_EQ(this->tick(m), fault_none);
  m.bus_V = S(0.3);
  for (int n = 0; n < 5; ++n) EXPECT_EQ(this->tick(m), fault_none);
}

TYPED_TEST(Faults, AVoltageMayBeWrongForShorterThanItsTime) {
  using S = TypeParam;
  Measurement<S> low = this->good;
  low.bus_V = S(0.1);
  for (int n = 0; n < 10; ++n) {
    EXPECT_EQ(this->tick(low), fault_none);
    EXPECT_EQ(this->tick(low), fault_none);
    EXPECT_EQ(this->tick(this->good), fault_none);
  }
}

TYPED_TEST(Faults, StallIsCurrentWithoutAnEdgeForTooLong) {
  const FaultEvents moved{.moved = true}, still{};
  for (int n = 0; n < 4; ++n) EXPECT_EQ(this->tick(this->good, still), fault_none);
  EXPECT_EQ(this->tick(this->good, moved), fault_none) << "an edge starts the time anew";
  for (int n = 0; n < 4; ++n) EXPECT_EQ(this->tick(this->good, still), fault_none);
  Measurement<TypeParam> idle = this->good;
  idle.i_a_A = idle.i_b_A = TypeParam{};
  EXPECT_EQ(this->tick(idle, still), fault_none) << "and so does a current that is gone";
  for (int n = 0; n < 4; ++n) EXPECT_EQ(this->tick(this->good, still), fault_none);
  EXPECT_EQ(this->tick(this->good, still), fault_stall);
}

TYPED_TEST(Faults, TheFirstReasonStaysTheReason) {
  using S = TypeParam;
  Measurement<S> fast = this->good;
  fast.speed_rad_s = S(1.0);
  this->tick(this->good, {.hall = true, .hall_line = 2, .moved = true});
  EXPECT_EQ(this->tick(fast, {.hall = true, .hall_line = 3}), fault_hall | fault_over_speed);
  EXPECT_EQ(this->state.first, fault_hall);
  EXPECT_EQ(this->state.hall_line, 2);
}

TYPED_TEST(Faults, DefaultsTrustNothing) {
  this->config = FaultConfig<TypeParam>{};
  EXPECT_NE(this->tick(this->good), fault_none);
}

TEST(FaultsOfNumbers, WhatIsNotANumberTrips) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const FaultConfig<double> config{1, 1, 0, 1, 1, 5, 1};
  for (int n = 0; n < 5; ++n) {
    Measurement<double> m{.bus_V = 0.5};
    (n == 0 ? m.i_a_A : n == 1 ? m.i_b_A : n == 2 ? m.i_c_A : n == 3 ? m.speed_rad_s : m.bus_V) = nan;
    FaultState state;
    EXPECT_NE(fault_step(config, state, m, {}), fault_none) << n;
  }
}

TEST(Activities, EveryTransitionOfThePicture) {
  using enum Activity;
  struct Row {
    Activity from;
    ActivityInput in;
    Activity to;
  };
  const Request start{.run = true}, stop{};
  const Row rows[] = {
      {off, {.request = stop, .calibrated = true, .aligned = true}, off},
      {off, {.request = start}, calibrate},
      {off, {.request = start, .calibrated = true}, align},
      {calibrate, {.request = start}, calibrate},
      {calibrate, {.request = start, .calibrated = true}, align},
      {calibrate, {.request = stop, .calibrated = true}, off},
      {align, {.request = start, .calibrated = true}, align},
      {align, {.request = start, .calibrated = true, .aligned = true}, run},
      {align, {.request = stop, .aligned = true}, off},
      {run, {.request = start}, run},
      {run, {.request = stop}, brake},
      {brake, {.request = stop}, brake},
      {brake, {.request = stop, .standing = true}, off},
      {brake, {.request = start}, run},
      {fault, {.request = stop}, off},
      {fault, {.request = start}, off},
  };
  for (const Row& row : rows) {
    ActivityState state{.activity = row.from};
    EXPECT_EQ(activity_step(state, row.in), row.to) << static_cast<int>(row.from);
    ActivityInput bad = row.in;
    bad.faulty = true;
    state.activity = row.from;
    EXPECT_EQ(activity_step(state, bad), fault) << "a fault wins everywhere";
  }
}

TEST(Activities, AFaultIsLeftOnlyByAFreshClearAndAFreshStart) {
  ActivityState state{.activity = Activity::run};
  const Request held{.run = true, .clear = true};
  EXPECT_EQ(clear_requested(state, held), false) << "not in a fault: nothing to clear, and now it is held";
  activity_step(state, {.request = held, .faulty = true});
  EXPECT_EQ(clear_requested(state, held), false) << "held since before the fault";
  EXPECT_EQ(clear_requested(state, {.run = true}), false);
  EXPECT_EQ(clear_requested(state, held), true) << "released and pressed again";
  EXPECT_EQ(activity_step(state, {.request = held}), Activity::off);
  EXPECT_EQ(activity_step(state, {.request = held}), Activity::off) << "run was held through the fault";
  EXPECT_EQ(activity_step(state, {.request = {}}), Activity::off);
  EXPECT_EQ(activity_step(state, {.request = {.run = true}}), Activity::calibrate);
}

TYPED_TEST(Faults, ASpeedOfAnEdgeThatNoRotorBringsIsToldAsBothUntilACodeProvesTheLine) {
  Measurement<TypeParam> fast = this->good;
  fast.speed_rad_s = TypeParam(0.75);
  EXPECT_EQ(this->tick(this->good, {.moved = true, .false_edge = 2}), fault_none) << "a speed like another";
  EXPECT_EQ(this->tick(fast, {.moved = true, .false_edge = 2}), fault_hall | fault_over_speed);
  EXPECT_EQ(this->state.hall_line, 0);
  this->tick(this->good, {.hall = true, .hall_line = 2});
  EXPECT_EQ(this->state.hall_line, 2);
}

}  // namespace SIXSTEP_TEST_FILE

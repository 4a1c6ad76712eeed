// SPDX-License-Identifier: Apache-2.0
// The no-load point, at which the mean shaft torque is 0, is compared with an independent solver and with the
// final speed of a free rotor.
#include "sixstep/analysis/curve/no_load.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/bench.hpp"

namespace SIXSTEP_TEST_FILE {

using namespace sixstep;
using namespace sixstep::testing;
using analysis::Bench;
using analysis::NoLoad;

NoLoad found(const Bench& b) {
  const base::Result<NoLoad> n = analysis::no_load(b);
  EXPECT_TRUE(n) << base::to_string(n.problems()[0]);
  return n ? *n : NoLoad{};
}

/// The largest deviation of a free rotor's speed from its mean within a sector. It is half the torque ripple,
/// acting for half a sector, divided by the inertia. The error of the mean speed is at most this deviation.
double swing_rad_s(const Bench& b, const NoLoad& n) {
  const double sector_s = base::sector_rad / (8 * std::fabs(n.point.speed_rad_s));
  return n.point.ripple_Nm / 2 * sector_s / 2 / b.motor.shaft.J_kg_m2;
}

TEST(NoLoad, OfThe251601IsThatOfTheIndependentSolver) {
  // data/scenarios/thesis/7.2-no-load.toml gives 702.6128 rad/s and 0.15310 A. The tolerance of the speed is
  // half of the last digit. The tolerance of the current is 1e-4 of the current, and the same again because
  // the averaging window cuts a sector.
  const NoLoad n = found(maxon_bench());
  EXPECT_NEAR(n.point.speed_rad_s, 702.6128, 5e-5);
  EXPECT_NEAR(n.point.winding_current_A, 0.15310, 3e-5);
  EXPECT_NEAR(n.point.shaft_torque_Nm, 0.0, 1e-12);
  EXPECT_EQ(*n.point.efficiency, 0.0);
  EXPECT_TRUE(n.settled);
}

TEST(NoLoad, SaysWhereAFreeRotorHadTooLittleTime) {
  Bench b = maxon_bench();
  b.motor.shaft.J_kg_m2 *= 100;  // a time constant of 3.5 s
  const NoLoad n = found(b);
  EXPECT_FALSE(n.settled);
  EXPECT_NEAR(n.time_constant_s, 3.5, 0.1);
  EXPECT_NEAR(n.free_s, analysis::longest_free_s, 0.1);
}

TEST(NoLoad, AFreeRotorAgrees) {
  for (const double coulomb : {0.0, 2.46e-3}) {
    Bench b = maxon_bench();
    b.motor.shaft.coulomb_Nm = coulomb;
    const NoLoad n = found(b);
    EXPECT_NEAR(n.free_speed_rad_s, n.point.speed_rad_s, swing_rad_s(b, n));
    // The relative difference of friction is equal to the relative difference of speed.
    const double part = swing_rad_s(b, n) / n.point.speed_rad_s;
    EXPECT_NEAR(n.free_winding_current_A, n.point.winding_current_A, 4 * part * n.point.winding_current_A);
    EXPECT_NEAR(n.free_bus_current_A, n.point.bus_current_A, 4 * part * n.point.bus_current_A);
  }
}

TEST(NoLoad, MirroredItTurnsBackwards) {
  Bench b = maxon_bench();
  const double forward = found(b).point.speed_rad_s;
  b.duty = -1;
  const NoLoad n = found(b);
  EXPECT_NEAR(n.point.speed_rad_s, -forward, 1e-9 * forward);
  EXPECT_NEAR(n.free_speed_rad_s, n.point.speed_rad_s, swing_rad_s(b, n));
}

TEST(NoLoad, WithoutFrictionIsVoltageOverTheTorqueConstant) {
  Bench b = maxon_bench();
  b.motor.shaft.B_Nm_s = 0;
  const NoLoad n = found(b);
  EXPECT_NEAR(n.point.speed_rad_s, 24 / 0.0335, 1e-9);
  EXPECT_NEAR(n.point.winding_current_A, 0.0, 1e-9);
}

TEST(NoLoad, ChoppedAFreeRotorLiesWithinTheInterval) {
  for (const control::Chopping chopping :
       {control::Chopping::soft, control::Chopping::hard, control::Chopping::complementary}) {
    Bench b = maxon_bench();
    b.duty = 0.6;
    b.chopping = chopping;
    const NoLoad n = found(b);
    EXPECT_GT(n.half_width_rad_s, 0.0);
    // The search ends when the interval of the torque contains zero. The resulting speed has an error of up
    // to one half width, and the interval of the true speed adds another half width.
    EXPECT_NEAR(n.free_speed_rad_s, n.point.speed_rad_s, 2 * n.half_width_rad_s + swing_rad_s(b, n))
        << name_of(chopping);
  }
}

TEST(NoLoad, IsRefusedWhereFrictionHoldsTheRotor) {
  Bench b = maxon_bench();
  b.motor.shaft.coulomb_Nm = 1.0;
  const base::Result<NoLoad> n = analysis::no_load(b);
  ASSERT_FALSE(n);
  EXPECT_NE(n.problems()[0].limit.find("friction"), std::string::npos);
}

}  // namespace SIXSTEP_TEST_FILE

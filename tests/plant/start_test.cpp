// SPDX-License-Identifier: Apache-2.0
// Tests the sector and the angle with which a run starts.
#include <gtest/gtest.h>

#include "tests/support/maxon.hpp"

namespace SIXSTEP_TEST_FILE {

using namespace sixstep;
using namespace sixstep::testing;

/// The fuzzer found this case: two conversions, from degrees to radians and from electrical to mechanical
/// angle, changed a start on an edge by a rounding error. From rest, the angle increases as t^3, so an error
/// of 2e-16 rad delayed the commutation by nanoseconds.
TEST(Start, AnAngleOnASectorEdgeIsOnIt) {
  for (int pole_pairs = 1; pole_pairs <= 21; ++pole_pairs)
    for (int edge = -14; edge <= 14; ++edge) {
      Drivetrain setup;
      setup.machine.pole_pairs = pole_pairs;
      setup.start.angle_rad = 60.0 * edge * base::pi / 180.0 / pole_pairs;
      const auto plant = setup.plant();
      EXPECT_EQ(plant.state().sector, edge) << pole_pairs << " pole pairs";
      EXPECT_EQ(plant.state().x, 0.0) << pole_pairs << " pole pairs, edge " << edge;
      EXPECT_EQ(plant.mode().piece, 0);
    }
}

/// A turning rotor on an edge has just passed the edge, forwards or backwards. A rotor at rest on an edge is
/// in the sector that it will enter (model.md 4b).
TEST(Start, OnASectorEdgeTheRotorIsInTheSectorItTurnsInto) {
  for (const double flat_deg : {120.0, 100.0})  // one piece of back-EMF per sector, and three pieces
    for (int edge = -7; edge <= 7; ++edge)
      for (const double speed : {-300.0, 0.0, 300.0}) {
        Drivetrain setup;
        setup.machine.flat_deg = flat_deg;
        setup.start.angle_rad = at_electrical_deg(60.0 * edge);
        setup.start.speed_rad_s = speed;
        const auto plant = setup.plant();
        EXPECT_EQ(plant.state().sector, speed < 0 ? edge - 1 : edge);
        EXPECT_EQ(plant.state().x, speed < 0 ? base::sector_rad : 0.0);
        const int pieces = plant.constants().emf[plant.sector()].count;
        EXPECT_EQ(plant.mode().piece, speed < 0 ? pieces - 1 : 0);
      }
}

TEST(Start, AnAngleBesideAnEdgeIsBesideIt) {
  Drivetrain setup;
  setup.start.angle_rad = at_electrical_deg(60.0) * (1 - 1e-14);
  EXPECT_EQ(setup.plant().state().sector, 0);
  setup.start.angle_rad = -1e-300;
  EXPECT_EQ(setup.plant().state().sector, -1);
}

}  // namespace SIXSTEP_TEST_FILE

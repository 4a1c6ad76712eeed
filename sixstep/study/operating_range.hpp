// SPDX-License-Identifier: Apache-2.0
// What a scenario's sensors may come to see, from physics alone: the range over which a fixed-point drive is
// proved where nobody states another.
//
//   speed     (U + R_tt T/K_t)/K_t    the bus alone, or a load T that drives the motor into its own
//   resistance;
//                                     or the speed it starts with
//   current   (U + 2 K_e w)/R_tt      bus and back-EMF of two phases in one direction: full reversal at speed
//   bus       U, or what it starts with. What braking pumps into a bus that cannot sink is not in it: the
//   engineer
//             who allows that states the range.
//   setpoint  the largest of the reference
//   position  setpoint and starting angle, and the way to stop from the speed limit at full torque,
//             J w^2/(2 T): no position loop overshoots further without a load that drives it
#pragma once
#include "sixstep/design/scaling.hpp"
#include "sixstep/study/compile.hpp"
#include "sixstep/study/scenario.hpp"

namespace sixstep::study {

/// `compiled` is the scenario's own.
design::OperatingRange operating_range(const Scenario& scenario, const Compiled& compiled);

}  // namespace sixstep::study

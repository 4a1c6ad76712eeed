// SPDX-License-Identifier: Apache-2.0
// The parts of a random scenario, scaled to its motor and its supply.
#pragma once
#include "sixstep/study/scenario/scenario.hpp"
#include "tests/fuzz/draw.hpp"

namespace sixstep::testing {

/// Draws all values except title, motor and sheet, which are already set.
void draw_parts(Draw& draw, study::Scenario& s);

/// The natural scales of this motor with this supply.
struct Scales {
  double U_V, R_tt_ohm, L_tt_H, K_t_Nm_A, stall_A, top_rad_s, stall_Nm, sector_rad;
  double kept_A;  ///< largest current that the drive requests
};

void draw_control(Draw& draw, study::Scenario& s, Scales& of);
void draw_sensors(Draw& draw, study::Scenario& s, const Scales& of);
void draw_protection(Draw& draw, study::Scenario& s, const Scales& of);
/// A reference of any shape that ends within the remaining time `left_s`, in s.
study::Reference drawn_reference(Draw& draw, const study::Scenario& s, const Scales& of, double left_s);
void draw_events(Draw& draw, study::Scenario& s, const Scales& of);
void draw_measures(Draw& draw, study::Scenario& s);
/// Sets keys in some scenarios that need the general kernel.
void draw_general(Draw& draw, study::Scenario& s, const Scales& of);
/// Makes some scenarios field-oriented.
void draw_field(Draw& draw, study::Scenario& s, const Scales& of);
/// Sets other loops and another PWM in some six-step drives.
void draw_six_step(Draw& draw, study::Scenario& s);
/// Sets a profile in some position loops.
void draw_profile(Draw& draw, study::Scenario& s);

}  // namespace sixstep::testing

// SPDX-License-Identifier: Apache-2.0
// The parts of a drawn scenario, on the scales of motor and supply.
#pragma once
#include "sixstep/study/scenario/scenario.hpp"
#include "tests/fuzz/draw.hpp"

namespace sixstep::testing {

/// Fills everything except title, motor and sheet, which are already set.
void draw_parts(Draw& draw, study::Scenario& s);

/// The natural scales of this motor at this supply.
struct Scales {
  double U_V, R_tt_ohm, L_tt_H, K_t_Nm_A, stall_A, top_rad_s, stall_Nm, sector_rad;
  double kept_A;  ///< largest current that the drive requests
};

void draw_control(Draw& draw, study::Scenario& s, Scales& of);
void draw_sensors(Draw& draw, study::Scenario& s, const Scales& of);
void draw_protection(Draw& draw, study::Scenario& s, const Scales& of);
/// A reference of any shape that fits into the remaining time `left_s`, s.
study::Reference drawn_reference(Draw& draw, const study::Scenario& s, const Scales& of, double left_s);
void draw_events(Draw& draw, study::Scenario& s, const Scales& of);
void draw_measures(Draw& draw, study::Scenario& s);
/// Gives some scenarios keys that need the general kernel.
void draw_general(Draw& draw, study::Scenario& s, const Scales& of);
/// Makes some scenarios field-oriented.
void draw_field(Draw& draw, study::Scenario& s, const Scales& of);
/// Gives some six-step drives other loops and another PWM.
void draw_six_step(Draw& draw, study::Scenario& s);
/// Gives some position loops a profile.
void draw_profile(Draw& draw, study::Scenario& s);

}  // namespace sixstep::testing

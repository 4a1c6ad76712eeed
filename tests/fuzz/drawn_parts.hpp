// SPDX-License-Identifier: Apache-2.0
// The parts of a drawn scenario, each drawn on the scale that the motor and the supply give it.
#pragma once
#include "sixstep/study/scenario/scenario.hpp"
#include "tests/fuzz/draw.hpp"

namespace sixstep::testing {

/// Fills everything but title, motor and sheet, which are there.
void draw_parts(Draw& draw, study::Scenario& s);

/// What is natural for this motor at this supply.
struct Scales {
  double U_V, R_tt_ohm, L_tt_H, K_t_Nm_A, stall_A, top_rad_s, stall_Nm, sector_rad;
  double kept_A;  ///< current that the drive is asked for at most
};

void draw_control(Draw& draw, study::Scenario& s, Scales& of);
void draw_sensors(Draw& draw, study::Scenario& s, const Scales& of);
void draw_protection(Draw& draw, study::Scenario& s, const Scales& of);
/// `left_s`: how long it can last.
study::Reference drawn_reference(Draw& draw, const study::Scenario& s, const Scales& of, double left_s);
void draw_events(Draw& draw, study::Scenario& s, const Scales& of);
void draw_measures(Draw& draw, study::Scenario& s);
/// What needs the general kernel, of some.
void draw_general(Draw& draw, study::Scenario& s, const Scales& of);
/// Makes some field-oriented.
void draw_field(Draw& draw, study::Scenario& s, const Scales& of);
/// Gives some six-step drives other loops and another PWM.
void draw_six_step(Draw& draw, study::Scenario& s);
/// Gives some position loops a profile.
void draw_profile(Draw& draw, study::Scenario& s);

}  // namespace sixstep::testing

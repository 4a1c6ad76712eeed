// SPDX-License-Identifier: Apache-2.0
#include "sixstep/analysis/verify/scenario_loops.hpp"

#include "sixstep/study/scenario/believed_motor.hpp"

namespace sixstep::analysis {

namespace {

/// The loops of c's gains on this motor.
design::DriveLoops loops_on(const design::MotorModel& motor, const design::Sheet& sheet,
                            const plant::Shaft& shaft, const study::Scenario& s, const study::Compiled& c) {
  const control::DriveConfig<double>& drive = c.later.empty() ? c.drive : c.later.back().drive;
  const bool smooth = drive.extras.on && drive.extras.smooth_chopping;
  design::DriveLoops out{
      .motor = motor,
      .winding = driven_pair(motor, smooth ? control::Chopping::complementary : drive.chopping),
      .period_s = s.pwm.period_s,
      .late_periods = (c.board.delayed ? 1.0 : 0.0) + (c.board.sampled_in_middle ? 0.5 : 0.0),
      .current = {drive.current.d1, drive.current.d0},
      .speed = {drive.speed.d1, drive.speed.d0},
      .current_at_full_torque_A = drive.current_at_full_torque_A,
      .position_gain_rad_s_per_deg = drive.position_gain};
  out.motor.shaft = shaft;
  if (!c.field) return out;
  const control::FieldCurrentConfig<double>& field =
      c.later.empty() ? c.field->current : c.later.back().field->current;
  out.winding = quadrature_axis(design::field_machine(motor, sheet), field.decouples);
  out.current = {field.q.d1, field.q.d0};
  return out;
}

}  // namespace

design::DriveLoops loops_of(const study::Scenario& s, const study::Compiled& c) {
  return loops_on(c.motor, s.sheet, c.shaft, s, c);
}

design::DriveLoops believed_loops_of(const study::Scenario& s, const study::Compiled& c) {
  return loops_on(c.believed.motor, study::believed_sheet(s), c.believed.shaft, s, c);
}

}  // namespace sixstep::analysis

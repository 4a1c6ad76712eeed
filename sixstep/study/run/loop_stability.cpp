// SPDX-License-Identifier: Apache-2.0
#include "sixstep/study/run/loop_stability.hpp"

#include "sixstep/design/loops/field_current.hpp"
#include "sixstep/design/loops/transfer.hpp"
#include "sixstep/study/run/limit_remarks.hpp"

namespace sixstep::study {
namespace {

/// Control periods from a sample to the instant at which the output computed from it takes effect.
double wait_periods(const Pwm& pwm) {
  return pwm.delay_periods + (pwm.sample == SampleAt::middle ? 0.5 : 0.0);
}

}  // namespace

bool is_current_pi(const Scenario& s, const LoopGains& g) {
  const bool finite_set =
      s.control.drive == FirmwareKind::field && s.control.field.law == FieldLaw::finite_set;
  return g.loop.starts_with("current") && s.control.current.type == CurrentLoopType::pi && !finite_set;
}

design::DriveLoops current_loop_on(const Scenario& s, const design::MotorModel& motor,
                                   const design::Sheet& sheet, const LoopGains& g) {
  design::DriveLoops loops{.motor = motor,
                           .winding = design::driven_pair(motor, s.pwm.chopping),
                           .period_s = s.pwm.period_s,
                           .late_periods = wait_periods(s.pwm),
                           .current = {g.d1, g.d0}};
  if (s.control.drive == FirmwareKind::field) {
    const design::FieldMachine machine = design::field_machine(motor, sheet);
    loops.winding = {machine.R_ohm, g.loop == "current q" ? machine.L_q_H : machine.L_d_H};
  }
  return loops;
}

std::optional<base::Problem> unstable_current_loop(const Scenario& s, const design::MotorModel& motor,
                                                   const LoopGains& g) {
  if (!is_current_pi(s, g)) return std::nullopt;
  if (design::is_stable(closed(open_current_loop(current_loop_on(s, motor, s.sheet, g))).den))
    return std::nullopt;
  return base::Problem{
      "the " + g.loop + " loop", "",
      "is unstable with its gains (" + g.origin + ") on this motor's R and L at a control period of " +
          few_digits(1e6 * s.pwm.period_s) + " us: the current swings between its limits",
      "give smaller gains, or remove the gains so that the program designs them from settle_s"};
}

}  // namespace sixstep::study

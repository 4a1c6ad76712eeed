// SPDX-License-Identifier: Apache-2.0
#include "sixstep/study/run/loop_stability.hpp"

#include "sixstep/base/elementary.hpp"
#include "sixstep/design/loops/drive_loops.hpp"
#include "sixstep/design/loops/field_current.hpp"
#include "sixstep/design/loops/transfer.hpp"
#include "sixstep/study/compile/field_parts.hpp"
#include "sixstep/study/run/limit_remarks.hpp"

namespace sixstep::study {
namespace {

/// Periods from a sample to its answer.
double wait_periods(const Pwm& pwm) {
  return pwm.delay_periods + (pwm.sample == SampleAt::middle ? 0.5 : 0.0);
}

/// A PI on R and L with a held voltage that comes `wait` periods late: stable, as long as no limit acts?
bool is_stable_loop(const LoopGains& g, double R, double L, double period_s, double wait) {
  const int whole = static_cast<int>(wait);
  const double late_s = (wait - whole) * period_s;
  const double decay = base::exp(-R * period_s / L), behind = base::exp(-R * (period_s - late_s) / L);
  // In z - 1: the voltage before acts for late_s, the new one for the rest of the period.
  design::Transfer loop{{(1 - decay) / R, (1 - behind) / R}, {1 - decay, 1.0}};
  if (late_s > 0.0)
    loop.den = design::product(loop.den, {1.0, 1.0});
  else
    loop.num = {(1 - decay) / R};
  loop = design::series(design::series({{g.d1 + g.d0, g.d1}, {0.0, 1.0}}, loop), design::delay(whole));
  return design::is_stable(closed(loop).den);
}

/// Of the driven pair, or of an axis of the field-oriented drive.
bool is_stable_current(const Scenario& s, const design::MotorModel& motor, const LoopGains& g) {
  if (s.control.drive == FirmwareKind::field) {
    const design::FieldMachine machine = design::field_machine(motor, designed_sheet(s));
    const double L = g.loop == "current q" ? machine.L_q_H : machine.L_d_H;
    return is_stable_loop(g, machine.R_ohm, L, s.pwm.period_s, wait_periods(s.pwm));
  }
  const design::LoopWinding pair = design::driven_pair(motor, s.pwm.chopping);
  return is_stable_loop(g, pair.R_ohm, pair.L_H, s.pwm.period_s, wait_periods(s.pwm));
}

bool is_current_pi(const Scenario& s, const LoopGains& g) {
  const bool finite_set =
      s.control.drive == FirmwareKind::field && s.control.field.law == FieldLaw::finite_set;
  return g.loop.starts_with("current") && s.control.current.type == CurrentLoopType::pi && !finite_set;
}

}  // namespace

std::optional<base::Problem> unstable_current_loop(const Scenario& s, const design::MotorModel& motor,
                                                   const LoopGains& g) {
  if (!is_current_pi(s, g) || is_stable_current(s, motor, g)) return std::nullopt;
  return base::Problem{"the " + g.loop + " loop", "",
                       "is unstable with its gains (" + g.origin +
                           ") on this motor's R and L at a control period of " +
                           few_digits(1e6 * s.pwm.period_s) + " us: its current swings between its limits",
                       "give smaller gains, or leave them to the design"};
}

}  // namespace sixstep::study

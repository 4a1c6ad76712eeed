// SPDX-License-Identifier: Apache-2.0
#include "sixstep/study/run/commutation_remarks.hpp"

#include "sixstep/base/angle.hpp"
#include "sixstep/study/run/limit_remarks.hpp"
#include "sixstep/study/scenario/choices.hpp"

namespace sixstep::study {

namespace {

/// The duty step has no effect if 4 E + 3 R I is above U, because its duty is then 1. The overlap acts in
/// this case too. Symbols of commutation.md: back-EMF E and resistance R of a phase, current I, bus voltage
/// U.
bool acted(const Scenario& s, const RunWatch& w) {
  return w.held_a_commutation &&
         (w.held_other_duty || s.control.current.commutation == CurrentCommutation::overlap);
}

std::string named(const Scenario& s) {
  return "control.current.commutation = \"" +
         std::string(base::word(current_commutation_choices, s.control.current.commutation)) + "\"";
}

/// The factor of E in the voltage U - 2 E - 3 R I/2 that reduces the leaving phase's current
/// (commutation.md). It is 2 on the flat top of a trapezoid. For a sine it is 1.5: twice the mean of the peak
/// 1 and of half the peak.
double emf_share(const design::MotorModel& motor) {
  return motor.machine.back_emf == plant::BackEmf::sine ? 1.5 : 2.0;
}

}  // namespace

std::string on_idle_duty_step(const Scenario& s, const RunWatch& w) {
  if (s.control.current.commutation == CurrentCommutation::plain || acted(s, w)) return {};
  if (w.held_a_commutation)
    return named(s) +
           " has no effect in this run: the duty is 1 at each commutation anyway, because the bus is too low for this speed and current; use a higher supply.voltage_V or a lower speed";
  return named(s) +
         " has no effect in this run. The control acts only while the motor drives, at edges where the leaving phase's current lasts longer than (1/2 + pwm.delay_periods) pwm.period_s = " +
         few_digits(1e6 * (0.5 + s.pwm.delay_periods) * s.pwm.period_s) +
         " us, and this run has no such edge; set a shorter pwm.period_s to lower this bound";
}

std::string on_chopped_staying_leg(const Scenario& s, const RunWatch& w) {
  using control::PwmPattern;
  const PwmPattern pattern = s.pwm.pattern;
  if (s.control.current.commutation == CurrentCommutation::plain || !acted(s, w) || !w.held_other_duty ||
      pattern == PwmPattern::pwm_on || pattern == PwmPattern::pwm_on_pwm)
    return {};
  return named(s) + " with pwm.pattern = \"" + std::string(base::word(pattern_choices, pattern)) +
         "\" causes a larger current peak and a deeper torque dip than \"pwm-on\". At some commutations this pattern chops the staying leg: a duty above 1/2 then stays in effect for up to one period after the commutation";
}

/// Margin of longest_overlap_rad_s(): because of the current's ripple, an overlap lowers the torque from 0.98
/// of the computed speed on.
constexpr double near_it = 0.98;

double longest_overlap_rad_s(const design::MotorModel& motor, double current_A, double bus_V) {
  const plant::Machine& m = motor.machine;
  const double per_rad_s = m.pole_pairs * m.L_H * current_A / (base::pi / 3);
  return near_it * (bus_V - 1.5 * m.R_ohm * current_A) / (per_rad_s + emf_share(motor) * m.K_e_V_s);
}

std::string on_long_overlap(const Scenario& s, const design::MotorModel& motor, double bus_V,
                            const RunWatch& w) {
  if (s.control.current.commutation != CurrentCommutation::overlap || !(w.held_A > 0.0)) return {};
  const double limit_rad_s = longest_overlap_rad_s(motor, w.held_A, bus_V);
  if (w.held_rad_s <= limit_rad_s) return {};
  const plant::Machine& m = motor.machine;
  const double left_V = bus_V - emf_share(motor) * m.K_e_V_s * w.held_rad_s - 1.5 * m.R_ohm * w.held_A;
  const double sector_s = base::pi / 3 / (m.pole_pairs * w.held_rad_s);
  std::string text =
      named(s) + " lowers the torque when the leaving phase's current lasts about a sector or longer: at " +
      few_digits(w.held_rad_s) + " rad/s and a reference of " + few_digits(w.held_A) + " A this current ";
  text += left_V > 0.0 ? "lasts " + few_digits(1e3 * m.L_H * w.held_A / left_V) + " ms, and a sector lasts " +
                             few_digits(1e3 * sector_s) + " ms"
                       : "does not end within a sector";
  if (limit_rad_s > 0.0)
    text += "; at this current and bus the limit is " + few_digits(limit_rad_s / near_it) + " rad/s";
  return text + "; try \"duty-step\" or a higher supply.voltage_V";
}

}  // namespace sixstep::study

// SPDX-License-Identifier: Apache-2.0
#include "sixstep/study/run/commutation_remarks.hpp"

#include "sixstep/study/run/limit_remarks.hpp"
#include "sixstep/study/scenario/choices.hpp"

namespace sixstep::study {

std::string on_idle_duty_step(const Scenario& s, const RunWatch& w) {
  const CurrentCommutation kind = s.control.current.commutation;
  if (kind == CurrentCommutation::plain || w.held_a_commutation) return {};
  return "control.current.commutation = \"" + std::string(base::word(current_commutation_choices, kind)) +
         "\" has no effect in this run: it acts only at edges of a motor that drives, where the leaving phase's "
         "current lasts longer than (1/2 + pwm.delay_periods) pwm.period_s = " +
         few_digits(1e6 * (0.5 + s.pwm.delay_periods) * s.pwm.period_s) +
         " us; no edge of this run is one: a shorter pwm.period_s makes it act sooner";
}

std::string on_chopped_staying_leg(const Scenario& s, const RunWatch& w) {
  using control::PwmPattern;
  const PwmPattern pattern = s.pwm.pattern;
  if (s.control.current.commutation == CurrentCommutation::plain || !w.held_a_commutation ||
      pattern == PwmPattern::pwm_on || pattern == PwmPattern::pwm_on_pwm)
    return {};
  return "control.current.commutation = \"" +
         std::string(base::word(current_commutation_choices, s.control.current.commutation)) +
         "\" with pwm.pattern = \"" + std::string(base::word(pattern_choices, pattern)) +
         "\" leaves a larger peak of the current and a deeper dip of the torque than with \"pwm-on\": where the "
         "staying leg is chopped, the duty that holds its current is above 1/2, and acts for up to a period after the "
         "commutation";
}

}  // namespace sixstep::study

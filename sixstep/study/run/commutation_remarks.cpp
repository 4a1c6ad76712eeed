// SPDX-License-Identifier: Apache-2.0
#include "sixstep/study/run/commutation_remarks.hpp"

#include "sixstep/study/run/limit_remarks.hpp"

namespace sixstep::study {

std::string on_idle_duty_step(const Scenario& s, const RunWatch& w) {
  const CurrentCommutation kind = s.control.current.commutation;
  if (kind == CurrentCommutation::plain || w.held_a_commutation) return {};
  const std::string name = kind == CurrentCommutation::overlap ? "overlap" : "duty-step";
  return "control.current.commutation = \"" + name +
         "\" has no effect in this run: it acts only at edges of a motor that drives, where the leaving phase's "
         "current lasts longer than (1/2 + pwm.delay_periods) pwm.period_s = " +
         few_digits(1e6 * (0.5 + s.pwm.delay_periods) * s.pwm.period_s) +
         " us; no edge of this run is one: a shorter pwm.period_s makes it act sooner";
}

}  // namespace sixstep::study

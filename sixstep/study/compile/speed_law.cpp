// SPDX-License-Identifier: Apache-2.0
// Designs a speed controller that is not a PI, for the same settling time as a PI.
#include "sixstep/design/loops/speed_laws.hpp"

#include "sixstep/study/compile/basis.hpp"
#include "sixstep/study/scenario/choices.hpp"

namespace sixstep::study {

namespace {

/// Mean delay between the speed controller's output and the torque, in samples. The current loop causes it,
/// or the winding if the output is a duty.
double lag_periods(const Scenario& s, const Basis& basis, const control::DriveConfig<double>& drive) {
  const double R_ohm = 2 * basis.motor.machine.R_ohm, L_H = 2 * basis.motor.machine.L_H;
  const double late = s.pwm.delay_periods + (s.pwm.sample == SampleAt::middle ? 0.5 : 0.0);
  if (s.control.speed.output == SpeedOutput::duty) return L_H / (R_ohm * s.pwm.period_s) + late;
  if (s.control.drive == FirmwareKind::field) return field_lag_periods(s, basis);
  if (drive.current_control == control::CurrentControl::hysteresis)
    return s.control.current.comparator == Comparator::sampled ? late + 0.5 : 0.0;
  return design::current_lag_periods(R_ohm, drive.current.d1 + drive.current.d0);
}

/// Renames problems: the design names its own quantities, but a user's file has the scenario's keys.
base::Problems under_the_keys(base::Problems problems) {
  for (base::Problem& p : problems) p.where = "control.speed." + p.where;
  return problems;
}

base::Result<design::SpeedLawDesign> designed(SpeedLaw law, const design::SpeedLawSpec& spec) {
  switch (law) {
    case SpeedLaw::state_feedback:
      return design::state_feedback(spec);
    case SpeedLaw::disturbance_rejection:
      return design::disturbance_rejection(spec);
    case SpeedLaw::sliding_mode:
      return design::sliding_mode(spec);
    case SpeedLaw::pi:
      break;
  }
  return design::SpeedLawDesign{};
}

}  // namespace

base::Problems add_speed_law(const Scenario& s, const Basis& basis, double full_rad_s2, double fades_1_s,
                             Tuned& out) {
  const SpeedLoop& loop = s.control.speed;
  if (loop.law == SpeedLaw::pi) return {};
  design::SpeedLawSpec spec;
  spec.full_rad_s2 = full_rad_s2;
  spec.fades_1_s = fades_1_s;
  spec.lag_periods = lag_periods(s, basis, out.drive);
  spec.limit = out.drive.speed.limit;
  spec.settle_s = loop.settle_s.value_or(design::usual_speed_settle_s);
  spec.ratio = loop.observer_ratio.value_or(design::usual_observer_ratio);
  spec.period_s = s.pwm.period_s;
  base::Result<design::SpeedLawDesign> law = designed(loop.law, spec);
  if (!law) return under_the_keys(law.problems());
  control::DriveExtras<double>& extras = out.drive.extras;
  extras.on = true;
  extras.speed_law =
      loop.law == SpeedLaw::sliding_mode ? control::SpeedLaw::sliding : control::SpeedLaw::observed;
  extras.laws = law->gains;
  LoopGains gains;
  gains.loop = "speed";
  gains.d1 = law->K;
  gains.origin = std::string(base::word(speed_law_choices, loop.law)) + " for settle_s and observer_ratio";
  gains.steps = std::move(law->steps);
  out.gains.back() = std::move(gains);
  return {};
}

}  // namespace sixstep::study

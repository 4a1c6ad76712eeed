// SPDX-License-Identifier: Apache-2.0
#include "sixstep/study/run/low_side_limits.hpp"

#include <bit>

#include "sixstep/study/run/limit_remarks.hpp"
#include "sixstep/study/scenario/low_side_window.hpp"
#include "sixstep/study/scenario/sensors_description.hpp"

namespace sixstep::study {
namespace {

/// What the shunts show of a driven pair.
std::string of_pair(const Scenario& s, const control::LowSideConfig<double>& window) {
  if (s.pwm.chopping == control::Chopping::hard || s.pwm.pattern != control::PwmPattern::upper)
    return "; a sink whose lower switch is chopped is shown at the sample from a duty of " +
           few_digits(window.least_duty) + " on";
  const int shunts = std::popcount(window.shunts);
  return shunts == 3 ? "; the sink's lower switch stays on, and its shunt shows the current at every duty"
         : shunts == 2
             ? "; in a third of the sectors only the source has a shunt, elsewhere that of the sink shows "
               "the current at every duty"
             : "; in a third of the sectors the pair has no shunt, in another third only the source has";
}

}  // namespace

std::string low_side_limits(const Scenario& s) {
  if (s.sensors.currents != rig::CurrentMeasurement::low_side) return {};
  const control::LowSideConfig<double> window = low_side_of(s);
  std::string text = "low-side shunts " + std::string(base::word(shunt_choices, s.sensors.shunts));
  text += window.greatest_duty > 0
              ? " show a chopped leg's current up to a duty of " + few_digits(window.greatest_duty)
              : std::string(" do not show the current of a leg whose upper switch is chopped");
  text += " (" + window_keys(s) + ")";
  if (const std::optional<double> most = greatest_modulation(s))
    return text + ", and two currents at every angle up to a modulation of " + few_digits(*most) +
           ", where 1 is a phase voltage of U_s/sqrt 3";
  const bool legs = s.control.drive == FirmwareKind::field || s.control.drive == FirmwareKind::own;
  return legs ? text : text + of_pair(s, window);
}

std::string blind_samples(const Scenario& s, const Outcome& out) {
  if (out.blind_samples == 0) return {};
  return std::to_string(out.blind_samples) + " of " + std::to_string(out.shunt_samples) +
         " control periods had no valid current sample, and the drive kept its last values: " +
         low_side_limits(s);
}

}  // namespace sixstep::study

// SPDX-License-Identifier: Apache-2.0
#include "sixstep/study/scenario/low_side_window.hpp"

#include <algorithm>
#include <cmath>

#include "sixstep/base/decimal.hpp"
#include "sixstep/base/written.hpp"

namespace sixstep::study {

namespace {

/// Time between the timer's edge that ends an upper pulse and the instant from which the leg's current certainly
/// flows below. A current into the leg first flows through the upper diode for a dead time. Soft and hard chopping
/// turn on no other switch of the leg.
double dead_s(const Scenario& s) {
  const bool legs = s.control.drive == FirmwareKind::field || s.control.drive == FirmwareKind::own;
  const bool both = s.pwm.chopping == control::Chopping::complementary || s.control.smooth_chopping.on;
  return legs || both ? s.bridge.dead_time_s : 0.0;
}

}  // namespace

/// A sample at a period's start lies after the pulses, a sample in the middle within a centred pulse.
control::LowSideConfig<double> low_side_of(const Scenario& s) {
  control::LowSideConfig<double> to;
  const Sensors& from = s.sensors;
  if (from.currents != rig::CurrentMeasurement::low_side) return to;
  const double T = s.pwm.period_s;
  const double late = (from.shunt_settle_s + from.current_delay_s + dead_s(s)) / T;
  const double shortest = std::max(from.shunt_least_on_s, s.pwm.minimum_pulse_s) / T;
  const bool centre = s.pwm.alignment == Alignment::centre;
  to.shunts = static_cast<std::uint8_t>(from.shunts);
  if (s.pwm.sample == SampleAt::middle) {
    to.greatest_duty = std::min(centre ? 0.0 : 0.5 - late, 1 - shortest);
    to.least_duty = std::max(centre ? 2 * late : 0.5, shortest);
  } else {
    to.greatest_duty = 1 - std::max(centre ? 2 * late : late, shortest);
  }
  return to;
}

/// Space vector modulation m has the duties 1/2 + (m/sqrt 3)(cos - (max cos + min cos)/2). Over a turn the largest
/// of the three reaches (1 + m)/2, the middle one 1/2 + sqrt 3 m/4.
std::optional<double> greatest_modulation(const Scenario& s) {
  if (s.control.drive != FirmwareKind::field || s.control.field.law != FieldLaw::pi) return std::nullopt;
  const double beyond_half = low_side_of(s).greatest_duty - 0.5;
  const double factor = s.sensors.shunts == ShuntLegs::abc ? 4 / std::sqrt(3.0) : 2.0;
  return std::clamp(factor * beyond_half, 0.0, 1.0);
}

std::string window_keys(const Scenario& s) {
  std::string keys;
  const auto add = [&keys](const char* key, double time_s) {
    if (time_s > 0)
      keys += (keys.empty() ? "" : ", ") + std::string(key) + " = " + base::rounded(1e6 * time_s, 3) + " us";
  };
  add("sensors.shunt_settle_s", s.sensors.shunt_settle_s);
  add("sensors.current_delay_s", s.sensors.current_delay_s);
  add("bridge.dead_time_s", dead_s(s));
  add("sensors.shunt_least_on_s", s.sensors.shunt_least_on_s);
  add("pwm.minimum_pulse_s", s.pwm.minimum_pulse_s);
  return keys.empty() ? "by pwm.sample and pwm.alignment" : keys;
}

}  // namespace sixstep::study

// SPDX-License-Identifier: Apache-2.0
#include "sixstep/study/check_product.hpp"

#include <optional>
#include <string>

#include "sixstep/base/written.hpp"

namespace sixstep::study {

namespace {

using base::written;
using control::Mode;

/// Registers are all that it is given.
void check_registers(const Scenario& s, base::Problems& out) {
  const std::string asks =
      "is nothing that a register shows, and control.drive = \"product\" reads registers";
  if (s.sensors.currents == rig::CurrentSensing::ideal)
    out.push_back({"sensors.currents", "\"ideal\"", asks,
                   "set currents = \"phases\" (or \"dc-link\") and current_range_A"});
  if (s.sensors.bus == BusSensing::ideal)
    out.push_back({"sensors.bus", "\"ideal\"", asks, "set bus = \"adc\" and bus_range_V"});
  if (s.sensors.rotor == RotorSensing::ideal)
    out.push_back({"sensors.rotor", "\"ideal\"", asks, "set rotor = \"hall\""});
  if (s.sensors.currents == rig::CurrentSensing::dc_link && s.pwm.delay_periods > 0)
    out.push_back({"pwm.delay_periods", std::to_string(s.pwm.delay_periods),
                   "leaves the product drive with the duty of another period than its shunt's sample",
                   "set delay_periods = 0: with pwm.sample = \"middle\" the answer waits for the next start "
                   "anyway"});
}

/// A threshold that is missing, or that the converter's end hides.
void check_threshold(const char* key, const std::optional<double>& threshold, const char* range_key,
                     const std::optional<double>& range, base::Problems& out) {
  const std::string where = std::string("protection.") + key;
  if (!threshold)
    out.push_back({where, "", "is missing: without it the product drive trusts nothing and never starts",
                   range_key[0] != '\0' ? "give one below " + std::string(range_key) : "give one"});
  else if (range && !(*threshold < *range))
    out.push_back(
        {where, written(*threshold),
         "is never passed: the converter ends at " + std::string(range_key) + " = " + written(*range),
         "lower it or widen the range"});
}

void check_thresholds(const Scenario& s, base::Problems& out) {
  const Protection& p = s.protection;
  check_threshold("over_current_A", p.over_current_A, "sensors.current_range_A", s.sensors.current_range_A,
                  out);
  check_threshold("over_voltage_V", p.over_voltage_V, "sensors.bus_range_V", s.sensors.bus_range_V, out);
  check_threshold("under_voltage_V", p.under_voltage_V, "protection.over_voltage_V", p.over_voltage_V, out);
  check_threshold("over_speed_rad_s", p.over_speed_rad_s, "", std::nullopt, out);
  if (p.stall_current_A.has_value() != p.stall_s.has_value())
    out.push_back({p.stall_s ? "protection.stall_current_A" : "protection.stall_s", "",
                   "is missing, and stalling is watched by both", "give both or none"});
}

void check_activities(const Scenario& s, base::Problems& out) {
  const Protection& p = s.protection;
  const bool has_current_loop = s.control.mode != Mode::off && s.control.mode != Mode::duty;
  const std::string needs = "needs a current loop, and control.mode has none";
  if (p.align.current_A && !has_current_loop)
    out.push_back({"protection.align.current_A", written(*p.align.current_A), needs,
                   "leave it away, or control current, speed or position"});
  if (p.brake_current_A > 0 && !has_current_loop)
    out.push_back({"protection.brake_current_A", written(p.brake_current_A), needs,
                   "leave it away, or control current, speed or position"});
  if (p.off_at_s && !(*p.off_at_s < s.duration_s))
    out.push_back({"protection.off_at_s", written(*p.off_at_s),
                   "lies behind the end of the run (duration_s = " + written(s.duration_s) + ")",
                   "lengthen duration_s or let go earlier"});
}

void check_full_scale(const Scenario& s, base::Problems& out) {
  const FullScale& f = s.control.full_scale;
  if (f.current_A || f.voltage_V || f.speed_rad_s || f.position_deg)
    out.push_back({"control.full_scale", "",
                   "is not for the product drive: its full scale follows from what the converters span",
                   "leave it away"});
}

}  // namespace

void check_product(const Scenario& s, base::Problems& out) {
  const Protection& p = s.protection;
  if (s.control.drive == Drive::product) {
    check_registers(s, out);
    check_thresholds(s, out);
    check_activities(s, out);
    check_full_scale(s, out);
  } else if (p.over_current_A || p.over_voltage_V || p.under_voltage_V || p.over_speed_rad_s ||
             p.stall_current_A || p.stall_s || p.off_at_s || p.align.current_A || p.brake_current_A > 0) {
    out.push_back({"protection", "", "is watched by the product drive only",
                   "set control.drive = \"product\", or leave [protection] away"});
  }
}

void check_extras(const Scenario& s, base::Problems& out) {
  const CurrentLoop& loop = s.control.current;
  if (loop.type == CurrentLoopType::hysteresis && loop.back_emf_feed_forward)
    out.push_back({"control.current.back_emf_feed_forward", "true",
                   "has no voltage to be added to in a hysteresis", "remove it, or set type = \"pi\""});
  if (loop.type == CurrentLoopType::hysteresis && loop.measured_bus_from_V)
    out.push_back({"control.current.measured_bus_from_V", written(*loop.measured_bus_from_V),
                   "has no duty to correct in a hysteresis", "remove it, or set type = \"pi\""});
  if (s.control.limits.gain_A_s_per_rad && !s.control.limits.speed_rad_s)
    out.push_back({"control.limits.gain_A_s_per_rad", written(*s.control.limits.gain_A_s_per_rad),
                   "has no limit to lead up to", "give control.limits.speed_rad_s too"});
  const SmoothChopping& smooth = s.control.smooth_chopping;
  if (smooth.soft_above_A && smooth.complementary_below_A &&
      !(*smooth.soft_above_A > *smooth.complementary_below_A))
    out.push_back({"control.smooth_chopping.soft_above_A", written(*smooth.soft_above_A),
                   "must lie above complementary_below_A = " + written(*smooth.complementary_below_A),
                   "raise it"});
}

}  // namespace sixstep::study

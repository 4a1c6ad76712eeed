// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include "sixstep/study/check/unused_list.hpp"
#include "sixstep/study/scenario/changes.hpp"
#include "sixstep/study/scenario/draws.hpp"
#include "sixstep/study/scenario/sensors_description.hpp"

namespace sixstep::study {
namespace {

void of_ideal_rotor(const Scenario& s, Unused& out) {
  constexpr char reason[] = "sensors.rotor is ideal";
  const Sensors usual, &x = s.sensors;
  out.add("sensors.capture_Hz", x.capture_Hz, usual.capture_Hz, reason);
  out.add("sensors.timeout_s", x.timeout_s, usual.timeout_s, reason);
  out.add("sensors.watched", x.watched, usual.watched, reason);
}

/// Only the lean drive can ignore the bus; the other drives monitor it or compute with it.
bool is_bus_unread(const Scenario& s) {
  const auto reads = [](const Control& c) { return c.current.measured_bus_from_V || c.regeneration.limit_V; };
  return s.control.drive == FirmwareKind::lean && !reads(s.control) &&
         std::none_of(s.at.begin(), s.at.end(), [&](const At& at) { return retunes(at); });
}

/// Adds the keys of a shaft sensor other than the chosen sensor.
template <class Sensor>
void of_other_sensor(RotorSensing kind, const Sensor& given, RotorSensing chosen, Unused& out) {
  if (kind == chosen) return;
  const std::string name(base::word(rotor_sensing_choices, kind));
  out.add_table("sensors." + name, given, "sensors.rotor is not " + name);
}

}  // namespace

void unused_of_sensors(const Scenario& s, Unused& out) {
  const Sensors usual, &x = s.sensors;
  const bool no_terminals = s.control.drive != FirmwareKind::sensorless;
  const bool no_bus = x.bus == BusSensing::ideal, no_hall = x.rotor != RotorSensing::hall;
  if (x.currents == rig::CurrentMeasurement::ideal) {
    constexpr char reason[] = "sensors.currents is ideal";
    out.add("sensors.current_offset_A", x.current_offset_A, usual.current_offset_A, reason);
    out.add("sensors.current_noise_A", x.current_noise_A, usual.current_noise_A, reason);
    out.add("sensors.current_gain_error", x.current_gain_error, usual.current_gain_error, reason);
    out.add("sensors.calibrated", x.calibrated, usual.calibrated, reason);
    if (no_terminals) {
      out.add("sensors.current_bandwidth_Hz", x.current_bandwidth_Hz, usual.current_bandwidth_Hz, reason);
      out.add("sensors.current_delay_s", x.current_delay_s, usual.current_delay_s, reason);
    }
    if (no_terminals && s.control.drive != FirmwareKind::field)  // the field-oriented drive uses the range to
                                                                 // scale its injection
      out.add("sensors.current_range_A", x.current_range_A, usual.current_range_A, reason);
    if (no_bus && no_terminals && x.rotor != RotorSensing::resolver)
      out.add("sensors.adc_bits", x.adc_bits, usual.adc_bits, "nothing is converted");
  }
  if ((no_bus && no_terminals) || is_bus_unread(s)) {  // terminals are measured like the bus
    const char* const reason = no_bus ? "sensors.bus is ideal" : "the drive does not read the bus";
    out.add("sensors.bus_offset_V", x.bus_offset_V, usual.bus_offset_V, reason);
    out.add("sensors.bus_noise_V", x.bus_noise_V, usual.bus_noise_V, reason);
    out.add("sensors.bus_gain_error", x.bus_gain_error, usual.bus_gain_error, reason);
    out.add("sensors.bus_bandwidth_Hz", x.bus_bandwidth_Hz, usual.bus_bandwidth_Hz, reason);
    if (no_bus)
      // with a converter, the range is used even if the drive does not read the bus
      out.add("sensors.bus_range_V", x.bus_range_V, usual.bus_range_V, reason);
  }
  if (no_hall && no_terminals) {
    constexpr char reason[] = "sensors.rotor is not hall";
    out.add("sensors.speed_edges", x.speed_edges, usual.speed_edges, reason);
    if (x.rotor == RotorSensing::ideal) of_ideal_rotor(s, out);
  }
  if (draws_nothing(s)) out.add("sensors.seed", x.seed, usual.seed, "nothing is drawn");
  of_other_sensor(RotorSensing::encoder, x.encoder, x.rotor, out);
  of_other_sensor(RotorSensing::absolute, x.absolute, x.rotor, out);
  of_other_sensor(RotorSensing::resolver, x.resolver, x.rotor, out);
  const bool link = x.currents == rig::CurrentMeasurement::dc_link;
  const bool below = x.currents == rig::CurrentMeasurement::low_side;
  if (!link && !below)
    out.add("sensors.shunt_settle_s", x.shunt_settle_s, usual.shunt_settle_s,
            "sensors.currents is not dc-link or low-side");
  if (!link)
    out.add("sensors.commutation_samples", x.commutation_samples, usual.commutation_samples,
            "sensors.currents is not dc-link");
  if (!below) {
    constexpr char reason[] = "sensors.currents is not low-side";
    out.add("sensors.shunts", x.shunts, usual.shunts, reason);
    out.add("sensors.shunt_least_on_s", x.shunt_least_on_s, usual.shunt_least_on_s, reason);
  }
  if (!(x.hall_glitches_Hz > 0))
    out.add("sensors.hall_glitch_s", x.hall_glitch_s, usual.hall_glitch_s, "no sensors.hall_glitches_Hz");
  if (!x.hall_break.at_s) {
    out.add("sensors.hall_break.line", x.hall_break.line, usual.hall_break.line, "no hall_break.at_s");
    out.add("sensors.hall_break.level", x.hall_break.level, usual.hall_break.level, "no hall_break.at_s");
  }
  if (x.hall_angle != rig::HallAngleFrom::learned_edges)
    out.add("sensors.hall_calibration_turns", x.hall_calibration_turns, usual.hall_calibration_turns,
            "sensors.hall_angle is not calibrated");
}

}  // namespace sixstep::study

// SPDX-License-Identifier: Apache-2.0
#include "sixstep/study/check/sensorless.hpp"

#include <string>

#include "sixstep/base/written.hpp"
#include "sixstep/study/scenario/choices.hpp"
#include "sixstep/study/scenario/sensors_description.hpp"

namespace sixstep::study {

namespace {

/// The sample must lie in the middle of the on-time, where the pair keeps the star point at half of the bus.
void check_sample(const Scenario& s, base::Problems& out) {
  const std::string why =
      "puts the sample outside the on-time, and the free phase's terminal shows the back-EMF only in the on-time";
  if (s.pwm.alignment != Alignment::centre)
    out.push_back({"pwm.alignment", "\"edge\"", why, "set alignment = \"centre\""});
  if (s.pwm.sample != SampleAt::middle)
    out.push_back({"pwm.sample", "\"start\"", why, "set sample = \"middle\""});
}

void check_sensorless_loops(const Scenario& s, base::Problems& out) {
  if (s.control.mode == control::Mode::position)
    out.push_back(
        {"control.mode", "\"position\"", "needs the rotor's angle at rest, where there is no back-EMF",
         "set control.mode = \"speed\", \"current\" or \"duty\", or control.drive = \"lean\" with a sensor in sensors.rotor"});
  if (s.control.current.type == CurrentLoopType::hysteresis)
    out.push_back({"control.current.type", "\"hysteresis\"",
                   "switches at any instant, so a sample of the terminals may lie outside an on-time",
                   "set type = \"pi\""});
  if (s.control.current.type == CurrentLoopType::deadbeat)
    out.push_back({"control.current.type", "\"deadbeat\"",
                   "predicts with Hall sectors, which the sensorless drive does not have at its start",
                   "set type = \"pi\""});
  if (s.pwm.pattern != control::PwmPattern::upper)
    out.push_back({"pwm.pattern", std::string(base::word(pattern_choices, s.pwm.pattern)),
                   "needs Hall sectors, which the sensorless drive does not have at its start",
                   "remove this key"});
  if (s.control.current.feedback != CurrentFeedback::mean)
    out.push_back({"control.current.feedback", "\"staying-phase\"",
                   "needs Hall sectors, which the sensorless drive does not have at its start",
                   "remove this key"});
  if (s.control.current.commutation != CurrentCommutation::plain)
    out.push_back({"control.current.commutation", "",
                   "needs Hall sectors, which the sensorless drive does not have at its start",
                   "remove this key"});
}

void check_source(const Scenario& s, base::Problems& out) {
  const RotorSensing rotor = s.sensors.rotor;
  if (rotor != RotorSensing::ideal && rotor != RotorSensing::hall)
    out.push_back({"sensors.rotor", std::string(base::word(rotor_sensing_choices, rotor)),
                   "is not supported by the sensorless drive, which reads Hall probes or no sensor",
                   "remove this key, set rotor = \"hall\", or control.drive = \"lean\""});
  const bool asked = s.control.sensorless.commutates == Commutates::hall;
  if (asked && rotor != RotorSensing::hall)
    out.push_back({"control.sensorless.commutates", "\"hall\"",
                   "needs Hall probes, and sensors.rotor is not \"hall\"", "set sensors.rotor = \"hall\""});
}

/// Pulses need a converter per phase, because each pulse is judged by the currents into and out of its pair.
void check_start(const Scenario& s, base::Problems& out) {
  if (s.control.sensorless.starts_by != StartsBy::pulses) return;
  if (s.sensors.currents == rig::CurrentMeasurement::phases) return;
  out.push_back({"sensors.currents", std::string(base::word(current_sensing_choices, s.sensors.currents)),
                 "has no converter per phase, which the drive needs to measure its start pulses",
                 "set currents = \"phases\" and current_range_A, or "
                 "control.sensorless.starts_by = \"alignment\""});
}

void check_others(const Scenario& s, base::Problems& out) {
  if (s.sensors.bus_bandwidth_Hz && control::observes(s.control.sensorless.follows))
    out.push_back(
        {"sensors.bus_bandwidth_Hz", base::written(*s.sensors.bus_bandwidth_Hz),
         "also filters the terminal voltages. After a diode turns off, a sample of a terminal voltage is wrong by up to half the bus voltage, and an observer keeps this error for some periods",
         "remove this key, or set control.sensorless.follows = \"crossings\""});
  if (s.sheet.kind == design::MotorKind::linear)
    out.push_back({"control.drive", "\"sensorless\"",
                   "applies to rotary motors only, and this motor is linear",
                   "set drive = \"lean\" or \"product\""});
}

/// Requires the values of all three terminals or of none.
void check_terminals(const Scenario& s, base::Problems& out) {
  const auto three = [&](const char* key, const std::vector<double>& values) {
    if (!values.empty() && values.size() != 3)
      out.push_back({key, std::to_string(values.size()) + " values",
                     "must have 3 values, one for each terminal a, b, c",
                     "give 3 values, or remove this key"});
  };
  three("sensors.terminal_gain_error", s.sensors.terminal_gain_error);
  three("sensors.comparators.offset_V", s.sensors.comparators.offset_V);
  if (s.sensors.comparators != Comparators{} && s.control.sensorless.follows != control::Follow::comparators)
    out.push_back({"sensors.comparators", "",
                   "has no effect, because control.sensorless.follows is not \"comparators\"",
                   "set control.sensorless.follows = \"comparators\", or remove this key"});
}

/// Refuses keys of the terminals for a drive that does not measure them.
void check_no_terminals(const Scenario& s, base::Problems& out) {
  const auto refuse = [&](const std::string& key) {
    out.push_back({key, "", "applies to the terminals, which only the sensorless drive measures",
                   "set control.drive = \"sensorless\", or remove this key"});
  };
  if (!s.sensors.terminal_gain_error.empty()) refuse("sensors.terminal_gain_error");
  if (s.sensors.comparators != Comparators{}) refuse("sensors.comparators");
  for (std::size_t n = 0; n < s.at.size(); ++n)
    if (s.at[n].sensors.broken_divider != Wire::none)
      refuse("at[" + std::to_string(n) + "].sensors.broken_divider");
}

}  // namespace

void check_sensorless(const Scenario& s, base::Problems& out) {
  if (s.control.drive != FirmwareKind::sensorless) {
    if (s.control.sensorless != Sensorless{})
      out.push_back({"control.sensorless", "", "applies to the sensorless drive only",
                     "set control.drive = \"sensorless\", or remove this key"});
    check_no_terminals(s, out);
    return;
  }
  check_terminals(s, out);
  check_sample(s, out);
  check_sensorless_loops(s, out);
  check_source(s, out);
  check_start(s, out);
  check_others(s, out);
}

}  // namespace sixstep::study

// SPDX-License-Identifier: Apache-2.0
#include "sixstep/study/check/sensorless.hpp"

#include <string>

#include "sixstep/base/written.hpp"
#include "sixstep/study/scenario/choices.hpp"
#include "sixstep/study/scenario/sensors_description.hpp"

namespace sixstep::study {

namespace {

/// The sample must lie in the middle of the on-time, where the pair holds the star point at half of the bus.
void check_sample(const Scenario& s, base::Problems& out) {
  const std::string why =
      "puts the sample outside of the on-time, and only within it the free phase's terminal shows the "
      "back-EMF";
  if (s.pwm.alignment != Alignment::centre)
    out.push_back({"pwm.alignment", "\"edge\"", why, "set alignment = \"centre\""});
  if (s.pwm.sample != SampleAt::middle)
    out.push_back({"pwm.sample", "\"start\"", why, "set sample = \"middle\""});
}

void check_sensorless_loops(const Scenario& s, base::Problems& out) {
  if (s.control.mode == control::Mode::position)
    out.push_back({"control.mode", "\"position\"",
                   "needs the rotor's angle at rest, where there is no back-EMF",
                   "control speed, current or duty, or set control.drive = \"lean\" and sensors.rotor"});
  if (s.control.current.type == CurrentLoopType::hysteresis)
    out.push_back({"control.current.type", "\"hysteresis\"",
                   "switches whenever the current leaves its band, so that no sample of the terminals lies "
                   "in an on-time",
                   "set type = \"pi\""});
  if (s.control.current.type == CurrentLoopType::deadbeat)
    out.push_back({"control.current.type", "\"deadbeat\"",
                   "predicts by Hall sectors, and the sensorless drive starts without them",
                   "set type = \"pi\""});
  if (s.pwm.pattern != control::PwmPattern::upper)
    out.push_back({"pwm.pattern", std::string(base::word(pattern_choices, s.pwm.pattern)),
                   "needs Hall sectors, and the sensorless drive starts without them", "remove it"});
  if (s.control.current.feedback != CurrentFeedback::mean)
    out.push_back({"control.current.feedback", "\"staying-phase\"",
                   "needs Hall sectors, and the sensorless drive starts without them", "remove it"});
  if (s.control.current.commutation != CurrentCommutation::plain)
    out.push_back({"control.current.commutation", "",
                   "needs Hall sectors, and the sensorless drive starts without them", "remove it"});
}

void check_source(const Scenario& s, base::Problems& out) {
  const RotorSensing rotor = s.sensors.rotor;
  if (rotor != RotorSensing::ideal && rotor != RotorSensing::hall)
    out.push_back({"sensors.rotor", std::string(base::word(rotor_sensing_choices, rotor)),
                   "is not supported by the sensorless drive: it reads Hall probes or none",
                   "remove it, set rotor = \"hall\", or control.drive = \"lean\""});
  const bool asked = s.control.sensorless.commutates == Commutates::hall;
  if (asked && rotor != RotorSensing::hall)
    out.push_back({"control.sensorless.commutates", "\"hall\"", "needs Hall probes, and the board reads none",
                   "set sensors.rotor = \"hall\""});
}

/// Pulses need a converter per phase, because each pulse is judged by the currents into and out of its pair.
void check_start(const Scenario& s, base::Problems& out) {
  if (s.control.sensorless.starts_by != StartsBy::pulses) return;
  if (s.sensors.currents == rig::CurrentMeasurement::phases) return;
  out.push_back({"sensors.currents", std::string(base::word(current_sensing_choices, s.sensors.currents)),
                 "has no converter per phase, and the drive measures its start pulses with them",
                 "set currents = \"phases\" and current_range_A, or "
                 "control.sensorless.starts_by = \"alignment\""});
}

void check_others(const Scenario& s, base::Problems& out) {
  if (s.sensors.bus_bandwidth_Hz && control::observes(s.control.sensorless.follows))
    out.push_back(
        {"sensors.bus_bandwidth_Hz", base::written(*s.sensors.bus_bandwidth_Hz),
         "is also that of the terminals' dividers. After a diode turns off within the pulse, the sample is "
         "wrong by up to half the bus; an observer keeps this error for periods",
         "remove it, or set control.sensorless.follows = \"crossings\""});
  if (s.sheet.kind == design::MotorKind::linear)
    out.push_back({"control.drive", "\"sensorless\"", "starts turning motors, and this one is linear",
                   "set drive = \"lean\" or \"product\""});
}

/// Requires the values of all three terminals or of none.
void check_terminals(const Scenario& s, base::Problems& out) {
  const auto three = [&](const char* key, const std::vector<double>& values) {
    if (!values.empty() && values.size() != 3)
      out.push_back({key, std::to_string(values.size()) + " values", "is not 3, those of terminals a, b, c",
                     "give 3, or remove it"});
  };
  three("sensors.terminal_gain_error", s.sensors.terminal_gain_error);
  three("sensors.comparators.offset_V", s.sensors.comparators.offset_V);
  if (s.sensors.comparators != Comparators{} && s.control.sensorless.follows != control::Follow::comparators)
    out.push_back({"sensors.comparators", "", "acts at the terminals, and nothing reads its edges",
                   "set control.sensorless.follows = \"comparators\", or remove it"});
}

/// Refuses keys of the terminals for a drive that does not measure them.
void check_no_terminals(const Scenario& s, base::Problems& out) {
  const auto refuse = [&](const std::string& key) {
    out.push_back({key, "", "applies to the terminals, which only the sensorless drive measures",
                   "set control.drive = \"sensorless\", or remove it"});
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
                     "set control.drive = \"sensorless\", or remove it"});
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

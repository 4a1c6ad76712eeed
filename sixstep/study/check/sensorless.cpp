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
      "leaves the sample outside of the on-time, in which the floating terminal shows its back-EMF";
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
                   "switches whenever its band is left, and no sample of the terminals finds an on-time",
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
                   "is no sensor from which the sensorless drive can take over: it reads Hall probes or none",
                   "remove it, set rotor = \"hall\", or control.drive = \"lean\""});
  const bool asked = s.control.sensorless.commutates == Commutates::hall;
  if (asked && rotor != RotorSensing::hall)
    out.push_back({"control.sensorless.commutates", "\"hall\"",
                   "asks for probes that the board does not read", "set sensors.rotor = \"hall\""});
}

/// Pulses need a converter per phase, because each pulse is judged by the currents into and out of its pair.
void check_start(const Scenario& s, base::Problems& out) {
  if (s.control.sensorless.starts_by != StartsBy::pulses) return;
  if (s.sensors.currents == rig::CurrentMeasurement::phases) return;
  out.push_back({"sensors.currents", std::string(base::word(current_sensing_choices, s.sensors.currents)),
                 "has no converter per phase, by whose counts the drive judges the pulses that it starts by",
                 "set currents = \"phases\" and current_range_A, or "
                 "control.sensorless.starts_by = \"alignment\""});
}

void check_others(const Scenario& s, base::Problems& out) {
  if (s.sensors.bus_bandwidth_Hz && control::observes(s.control.sensorless.follows))
    out.push_back(
        {"sensors.bus_bandwidth_Hz", base::written(*s.sensors.bus_bandwidth_Hz),
         "is of the terminals' dividers, too: a leg that its diode lets go within the pulse is sampled on its way "
         "from the rail, by up to half the bus off, and an observer keeps that for periods",
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

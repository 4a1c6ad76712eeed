// SPDX-License-Identifier: Apache-2.0
#include "sixstep/study/run/faults.hpp"

#include <string>
#include <utility>

#include "sixstep/base/written.hpp"

namespace sixstep::study {

namespace {

std::string at(double t_s) { return "t = " + std::to_string(t_s) + " s"; }

std::string line_to_blame(int line) { return "line H" + std::to_string(line) + " does not follow the rotor"; }

}  // namespace

base::Problem stopped_by(rig::Fault fault, const rig::Diagnosis& found, double t_s) {
  if (fault == rig::Fault::shoot_through)
    return {at(t_s), "", "both switches of a leg were on: shoot-through",
            "look at the command that names one leg twice"};
  const std::string text = "the Hall code is impossible (000 or 111)";
  if (found.hall_line == 0) return {at(t_s), "", text, "look at the probes and their wires"};
  return {at(t_s), "", text + ": " + line_to_blame(found.hall_line), "look at its probe and its wire"};
}

base::Problem ran_away(const plant::State<double>& s, double t_s) {
  const auto [name, value] = [&s]() -> std::pair<const char*, double> {
    for (const double i : s.i)
      if (!(i - i == 0.0)) return {"a current", i};
    if (!(s.bus - s.bus == 0.0)) return {"the bus voltage", s.bus};
    return {"the speed", s.w};
  }();
  return {at(t_s), "", std::string("the run has run away: ") + name + " is " + base::rounded(value, 3),
          "look at the load, the friction and the moment of inertia, then at the supply"};
}

void note_trip(const rig::Diagnosis& found, Outcome& out) {
  struct Reason {
    control::Fault bit;
    const char* text;
    const char* cure;
  };
  static constexpr Reason reasons[] = {
      {control::fault_over_current, "over-current", "look at the current loop and protection.over_current_A"},
      {control::fault_over_voltage, "over-voltage",
       "brake less, let the supply take current back, or set control.regeneration.limit_V"},
      {control::fault_under_voltage, "under-voltage", "look at the supply and protection.under_voltage_V"},
      {control::fault_over_speed, "over-speed", "look at the load and protection.over_speed_rad_s"},
      {control::fault_hall, "an impossible Hall code, jump or edge", "look at the probes and their wires"},
      {control::fault_stall, "stall", "look at the load and protection.stall_s"},
      {control::fault_calibration, "the offset of a current amplifier",
       "look at sensors.current_offset_A and protection.offset_tolerance_A"},
      {control::fault_align, "a rotor that did not come to where it was pulled",
       "look at the load and protection.align"}};
  if (found.faults == 0) return;
  Trip trip{.at_s = found.at.seconds(), .reasons = {}, .hall_line = found.hall_line};
  std::string text, cure;
  for (const Reason& reason : reasons) {
    if ((found.faults & reason.bit) == 0) continue;
    trip.reasons.emplace_back(reason.text);
    text += (text.empty() ? "" : "; ") + trip.reasons.back();
    cure += (cure.empty() ? "" : "; ") + std::string(reason.cure);
  }
  if (found.hall_line != 0) {
    text += ": " + line_to_blame(found.hall_line);
    cure = "look at its probe and its wire";
  }
  out.fault = base::Problem{at(trip.at_s), "",
                            "the drive tripped by " + text + "; from there the motor coasts", cure};
  out.trip = std::move(trip);
}

}  // namespace sixstep::study

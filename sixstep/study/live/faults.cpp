// SPDX-License-Identifier: Apache-2.0
#include "sixstep/study/live/faults.hpp"

#include <cmath>
#include <string>
#include <utility>

#include "sixstep/base/written.hpp"

namespace sixstep::study {

namespace {

std::string at(double t_s) { return "t = " + std::to_string(t_s) + " s"; }

std::string line_to_blame(int line) { return "line H" + std::to_string(line) + " does not follow the rotor"; }

struct LossWords {
  const char* text;
  const char* cure;
};

LossWords words_of(control::LockLoss loss) {
  using control::LockLoss;
  switch (loss) {
    case LockLoss::masked_crossing:
      return {"an expected zero crossing did not occur",
              "lower the braking current or the load, or raise control.sensorless.lowest_part"};
    case LockLoss::long_demagnetisation:
      return {"the leaving phase's current hid the crossings",
              "lower control.slew, so that the duty or the current changes more slowly"};
    case LockLoss::wrong_sector:
      return {"the terminal voltages contradict the sector",
              "change the load torque and the supply voltage more slowly"};
    case LockLoss::terminals:
      return {"the terminals did not follow the bridge's command",
              "check the bridge, the motor's wires and the dividers"};
    case LockLoss::start:
      return {
          "the ramp ended without reliable crossings",
          "check load.locked and the load torque; raise control.sensorless.overload, or control.sensorless.greatest_load if the load is larger"};
    case LockLoss::none:
      break;
  }
  return {"the drive lost the rotor's position", "lower the load torque or its steps"};
}

void note_unseen(const rig::Diagnosis& found, Outcome& out) {
  const std::string times = found.unseen == 1 ? "" : " in " + std::to_string(found.unseen) + " starts";
  out.notes.push_back(
      "the pulses did not show which end of the magnet is north" + times + ": " +
      base::rounded(found.north, 2) + " times their noise; needed are at least " +
      base::rounded(found.certain, 2) +
      " times. So the drive aligned the rotor instead. Pulses show north only on a motor that saturates (saturation_current_A in the motor file)");
}

/// Reports that a sensorless drive lost the rotor's position: a note if the drive started again, a fault if
/// it stopped.
void note_losses(const rig::Diagnosis& found, Outcome& out) {
  const LossWords words = words_of(found.lost);
  const std::string times = found.losses == 1 ? "once" : std::to_string(found.losses) + " times";
  if (!found.gave_up) {
    out.notes.push_back("the drive lost the rotor " + times + ", at last at " + at(found.at.seconds()) +
                        ": " + words.text + "; it started again");
    return;
  }
  out.trip = Trip{.at_s = found.at.seconds(), .reasons = {words.text}, .hall_line = found.hall_line};
  out.fault = base::Problem{
      at(found.at.seconds()), "",
      "the drive lost the rotor " + times + " and stopped: " + words.text + "; then the motor coasts",
      words.cure};
}

/// The problem of an encoder or a resolver with signals that an intact sensor cannot produce.
base::Problem lost_sensor(const rig::ShaftFinding& found, double t_s) {
  using rig::ShaftLoss;
  const std::string part =
      std::to_string(static_cast<int>(std::floor(100 * found.shown + 0.5))) + " % of its amplitude";
  const auto winding = [&](const char* name) -> base::Problem {
    return {at(t_s), "", "the resolver shows " + part + ", and the " + name + " winding has no voltage",
            std::string("check the ") + name + " winding and its wires"};
  };
  switch (found.loss) {
    case ShaftLoss::excitation:
      return {at(t_s), "", "neither winding of the resolver has a voltage: the excitation is lost",
              "check the excitation and the resolver's wires"};
    case ShaftLoss::cosine:
      return winding("cosine");
    case ShaftLoss::sine:
      return winding("sine");
    case ShaftLoss::weak:
      return {at(t_s), "", "the resolver shows " + part + ", less than an intact resolver",
              "check the excitation, then the windings"};
    case ShaftLoss::strong:
      return {at(t_s), "", "the resolver shows " + part + ", more than an intact resolver",
              "check the excitation and sensors.resolver.amplitude_V"};
    case ShaftLoss::index:
      return {
          at(t_s), "",
          "the encoder's index came with " + std::to_string(found.counts) +
              " counts missing; a sector has fewer counts",
          "check the encoder's lines A, B and Z: sensors.encoder.missed_Hz and the [[at]] changes of the sensors"};
    case ShaftLoss::none:
      break;
  }
  return {};
}

/// Returns, for example, "mine.so: the controller answered duty = 1.5 in step 20".
std::string answered(const rig::OwnFinding& found) {
  const std::string file = found.controller;
  const double x = found.value;
  const std::string value = x != x ? "not a number" : x - x != 0.0 ? "infinite" : base::written(x);
  return (file.empty() ? "" : file + ": ") + "the controller answered " + found.field + " = " + value +
         (found.in_hall ? " in its hall() after step " : " in step ") + std::to_string(found.steps);
}

/// The problem of a user's controller whose answer the rig refuses.
base::Problem refused_answer(const rig::OwnFinding& found, double t_s) {
  using rig::OwnWrong;
  switch (found.what) {
    case OwnWrong::duty:
      return {at(t_s), "",
              answered(found) + ", which must lie in " +
                  (found.field == std::string("overlap") ? "-1" : "0") + " to 1",
              "limit this value in the controller, and check for a division by 0"};
    case OwnWrong::leg:
      return {at(t_s), "",
              answered(found) + (found.value > static_cast<double>(SIXSTEP_LEG_C)
                                     ? ", which is not a leg"
                                     : ", which is the same leg as source"),
              "let the controller answer source and sink as two different legs of a, b, c"};
    case OwnWrong::choice:
      return {at(t_s), "", answered(found) + ", which is not a value that own_controller.h defines",
              "use the constants of own_controller.h"};
    case OwnWrong::gave_up:
    case OwnWrong::none:
      break;
  }
  return {at(t_s), "", answered(found) + ": the controller reported a fault",
          "find the condition in the controller that reports this fault"};
}

base::Problem lost_core(rig::CoreTrouble trouble, double t_s) {
  using rig::CoreTrouble;
  if (trouble == CoreTrouble::differs)
    return {
        at(t_s), "", "the core's answer differs from the host's; both must agree in every bit",
        "check the core's compiler and flags; if these are unchanged, report this message, with the scenario file, in the issues of the repository"};
  if (trouble == CoreTrouble::silent)
    return {at(t_s), "", "the core did not answer in time: its program hangs, or its emulator does",
            "debug the function that was called last"};
  if (trouble == CoreTrouble::stalled)
    return {at(t_s), "", "the chip starts no conversion any more: its program hangs or has stopped",
            "check the program's waiting loops, and its reaction to an invalid Hall code"};
  return {at(t_s), "", "the core ended: its program caused a fault, or its emulator was stopped",
          "check the program's memory accesses and stack"};
}

}  // namespace

base::Problem stopped_by(rig::Fault fault, const rig::Diagnosis& found, double t_s) {
  if (fault == rig::Fault::shoot_through)
    return {
        at(t_s), "", "both switches of a leg were on: shoot-through",
        "look for a shorted switch (at.bridge.shorted_switch), and for a command with the same leg as source and sink"};
  if (fault == rig::Fault::beyond_model)
    return {
        at(t_s), "",
        "the current along the magnet's axis is above half of saturation_current_A, where the model of saturation ends",
        "lower control.current.limit_A, or correct saturation_current_A in the motor file"};
  if (fault == rig::Fault::core) return lost_core(found.core, t_s);
  if (fault == rig::Fault::own_controller) return refused_answer(found.own, t_s);
  if (fault == rig::Fault::north_unseen)
    return {
        at(t_s), "",
        "the injected pulses did not show which end of the magnet is north: " +
            base::rounded(100 * found.north, 2) + " % of their current; needed are at least " +
            base::rounded(100 * found.certain, 2) + " %",
        "check that the rotor is at rest and that the motor's wires are intact; raise control.field.injection_V, or check the sheet's saturation_current_A"};
  if (fault == rig::Fault::not_started)
    return {
        at(t_s), "",
        "the rotor did not follow the turning current in " + std::to_string(found.losses) +
            " starts, so the drive stopped",
        "check that the rotor can turn and that the load is at most T_start of the design; raise control.field.start_current_A, or give the drive a sensor"};
  if (fault == rig::Fault::shaft_sensor) return lost_sensor(found.shaft, t_s);
  const std::string text = "the Hall code is impossible (000 or 111)";
  if (found.hall_line == 0)
    return {
        at(t_s), "", text,
        "check the Hall lines: sensors.hall_lines, sensors.hall_break and the [[at]] changes of the sensors"};
  return {at(t_s), "", text + ": " + line_to_blame(found.hall_line),
          "check this Hall line's probe and wire: sensors.hall_break and the [[at]] changes of the sensors"};
}

base::Problem ran_away(const plant::State<double>& s, double t_s) {
  struct Quantity {
    const char *name, *unit;
    double value;
  };
  const Quantity found = [&s]() -> Quantity {
    for (const double i : s.i)
      if (!(i - i == 0.0)) return {"a current", " A", i};
    if (!(s.bus - s.bus == 0.0)) return {"the bus voltage", " V", s.bus};
    return {"the speed", " rad/s", s.w};
  }();
  return {
      at(t_s), "",
      std::string("the run diverged: ") + found.name + " is " + base::rounded(found.value, 3) + found.unit,
      "check the units of load torque, friction and moment of inertia, then of the [supply] values"};
}

void note_trip(const rig::Diagnosis& found, Outcome& out) {
  struct Reason {
    control::Fault bit;
    const char* text;
    const char* cure;
  };
  static constexpr Reason reasons[] = {
      {control::fault_over_current, "over-current",
       "give the current loop a longer settle_s, or raise protection.over_current_A"},
      {control::fault_over_voltage, "over-voltage",
       "brake with less current, set supply.sinks = true, or set control.regeneration.limit_V"},
      {control::fault_under_voltage, "under-voltage",
       "raise supply.voltage_V, or lower protection.under_voltage_V"},
      {control::fault_over_speed, "over-speed",
       "lower the speed reference or the load that drives the shaft, or raise protection.over_speed_rad_s"},
      {control::fault_hall, "an impossible Hall code, jump or edge",
       "check the Hall lines: sensors.hall_lines, sensors.hall_break and the [[at]] changes of the sensors"},
      {control::fault_stall, "stall", "lower the load torque, or raise protection.stall_s"},
      {control::fault_calibration, "the offset of a current amplifier",
       "lower sensors.current_offset_A, or raise protection.offset_tolerance_A"},
      {control::fault_align, "a rotor that did not reach the alignment position",
       "lower the load torque, or raise protection.align.current_A"}};
  if (found.faults == 0 && found.hall_line != 0)
    out.notes.push_back(line_to_blame(found.hall_line) + ": the drive continues without this line");
  if (found.unseen > 0) note_unseen(found, out);
  if (found.losses > 0) return note_losses(found, out);
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
    cure = "check this Hall line's probe and wire: sensors.hall_break and the [[at]] changes of the sensors";
  }
  out.fault =
      base::Problem{at(trip.at_s), "", "the drive tripped by " + text + "; then the motor coasts", cure};
  out.trip = std::move(trip);
}

void note_wires(unsigned still_closed, Outcome& out) {
  constexpr const char* wires[] = {"a", "b", "c"};
  for (unsigned k = 0; k < 3; ++k)
    if ((still_closed >> k & 1) != 0)
      out.notes.push_back(
          "wire " + std::string(wires[k]) +
          " was set to break, but carries current until the end of the run; a wire opens only when its current is zero");
}

}  // namespace sixstep::study

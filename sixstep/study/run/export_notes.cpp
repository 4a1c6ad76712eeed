// SPDX-License-Identifier: Apache-2.0
#include "sixstep/study/run/export_notes.hpp"

#include <algorithm>
#include <cmath>

#include "sixstep/base/written.hpp"
#include "sixstep/design/sheet/sheet_check.hpp"
#include "sixstep/design/sheet/thermal_ranges.hpp"
#include "sixstep/study/check/check.hpp"
#include "sixstep/study/run/export_gate.hpp"
#include "sixstep/study/run/export_protection.hpp"
#include "sixstep/study/run/export_watch.hpp"
#include "sixstep/study/run/limit_remarks.hpp"
#include "sixstep/study/run/thermal_remarks.hpp"
#include "sixstep/study/scenario/choices.hpp"
#include "sixstep/study/scenario/reference_waveform.hpp"
#include "sixstep/study/scenario/supply_voltages.hpp"

namespace sixstep::study {
namespace {

using control::Mode;

bool is_rectifier(const Supply& s) {
  return s.source == SourceKind::single_phase || s.source == SourceKind::three_phase;
}

constexpr const char* condition = "cleared for a supply that takes current back (supply.sinks = true)";

/// The first reason why the drive does not work with such a supply.
std::string first_of(const base::Problems& found) {
  const base::Problem& p = found.front();
  return p.where + (p.value.empty() ? " " : " = " + p.value + " ") + p.limit;
}

}  // namespace

std::string limit_above_nominal(const Scenario& s, const design::MotorModel& motor) {
  const bool cascade = s.control.mode == Mode::speed || s.control.mode == Mode::position;
  const double nominal_A = motor.nominal_current_A;
  if (!cascade || s.control.drive == FirmwareKind::field) return {};
  const std::optional<MostCurrent> most = most_current(s, motor);
  // A limit that was set to the nominal current may differ from it by rounding.
  if (!most || !(most->ampere > 1.005 * nominal_A)) return {};
  const auto times = withstand_times_of(s, motor, *most);
  if (!times && !(nominal_A > 0.0)) return {};
  if (times && !times->by_values && !times->by_worse_ends) return {};
  const bool linear = s.sheet.kind == design::MotorKind::linear;
  const std::string stands =
      times
          ? withstood(*times, start_temperatures(s.heat).winding_degC)
          : "; without thermal values in the sheet it is not known how long the winding withstands this current";
  const std::string multiple = nominal_A > 0.0
                                   ? ", " + few_digits(most->ampere / nominal_A) +
                                         " times the nominal current of " + few_digits(nominal_A) + " A"
                                   : "";
  return most->by + " lets " + few_digits(most->ampere) + " A flow" + multiple + stands +
         "; no protection of the drive ends this current while " +
         (linear ? "the slide moves" : "the rotor turns") +
         ": lower the current limit, or apply the load for " +
         (times ? "less than this time" : "a short time only");
}

std::vector<std::string> unchecked(const Scenario& s, const design::MotorModel& motor) {
  std::vector<std::string> all;
  const bool cascade = s.control.mode == Mode::speed || s.control.mode == Mode::position;
  const std::optional<MostCurrent> most = most_current(s, motor);
  const auto thermal = design::thermal_model(s.sheet);
  const auto add = [&all](const std::string& what, const std::string& missing) {
    all.push_back("not checked: " + what + ": the motor file has no " + missing +
                  "; give this value in the motor file or in [motor_override]");
  };
  if (!thermal && most && s.control.drive == FirmwareKind::product && s.protection.stall_s)
    add("whether the winding withstands " + few_digits(most->ampere) + " A, " + most->by +
            ", for protection.stall_s = " + base::six_digits(*s.protection.stall_s) + " s",
        thermal.problems().front().where);
  const bool known = thermal || motor.nominal_current_A > 0.0 || s.control.drive == FirmwareKind::field;
  if (cascade && most && !known)
    add("whether the motor withstands " + few_digits(most->ampere) + " A, " + most->by + ", continuously",
        "nominal_current_A and no thermal values");
  if (s.control.drive == FirmwareKind::product && s.protection.over_speed_rad_s && !s.sheet.max_speed_rpm)
    add("whether the rotor withstands protection.over_speed_rad_s = " +
            base::six_digits(*s.protection.over_speed_rad_s) + " rad/s",
        "max_speed_rpm");
  return all;
}

std::string sheet_contradiction(const Scenario& s) {
  if (!s.motor_sheet) return {};
  const base::Result<design::SheetCheck> check = design::check_sheet(*s.motor_sheet);
  return check ? design::contradiction_words(*check) : "";
}

WithoutSink without_sink(const Scenario& s, const design::MotorModel& motor, const Listeners& listeners) {
  const bool stated = !s.supply.sinks || std::any_of(s.at.begin(), s.at.end(),
                                                     [](const At& at) { return at.supply.sinks == false; });
  const bool charges = s.supply.source == SourceKind::battery;
  if (stated || charges || is_rectifier(s.supply) || s.control.mode == Mode::off) return {};
  WithoutSink w{.matters = true, .holds = false, .note = ""};
  if (!(s.supply.capacitance_F > 0.0) || !(s.supply.resistance_ohm > 0.0)) {
    w.note =
        std::string(condition) +
        ". The voltage of this stiff bus cannot rise; if your supply takes no current back, set supply.resistance_ohm, supply.capacitance_F and supply.sinks = false";
    return w;
  }
  Scenario other = s;
  other.supply.sinks = false;
  const base::Result<Outcome> ran =
      run(watching_peaks(other),
          {.on_record = {}, .on_event = {}, .keep_going = listeners.keep_going, .keep_books = false});
  base::Problems found = ran ? base::Problems{} : ran.problems();
  if (ran) {
    Outcome outcome = *ran;
    const SeenPeaks peaks = take_peaks(other, outcome);
    found = not_held(outcome);
    look_at_bus(other, peaks, s.sensors.bus == BusSensing::adc, listeners, found);
    if (found.empty()) look_at_stop(other, motor, listeners, found);
  }
  w.holds = found.empty();
  if (!w.holds)
    w.note = std::string(condition) + "; with a supply that takes no current back, " + first_of(found);
  return w;
}

std::string short_dead_time(const Scenario& s) {
  const bool igbt = s.bridge.device == Device::igbt;
  const double usual_s = igbt ? 500e-9 : 100e-9, dead_s = s.bridge.dead_time_s;
  if (s.control.mode == Mode::off || s.bridge.gate_current_A > 0.0 || !(dead_s > 0.0 && dead_s < usual_s))
    return {};
  return "bridge.dead_time_s = " + few_digits(1e9 * dead_s) + " ns is short: most " +
         (igbt ? "IGBTs" : "MOSFETs") + " with their drivers need " + few_digits(1e9 * usual_s) +
         " ns or more from the command until they are off, and the leg shorts the bus during this time. Set a dead time above the sum of the switch's turn-off delay and fall time, or give bridge.gate_current_A and the gate's charges";
}

std::string without_protection(const Scenario& s) {
  if (s.control.drive == FirmwareKind::product)
    return s.protection.stall_s ? "" : "no stall is detected: give protection.stall_current_A and stall_s";
  return "control.drive = \"" + std::string(base::word(drive_choices, s.control.drive)) +
         "\" has no protection: the bridge stays on at over-current, over-voltage and a stall; add a protection to your firmware, or export control.drive = \"product\" with [protection]";
}

std::string setpoint_bound(const Scenario& s) {
  if (s.control.drive != FirmwareKind::product || s.control.mode == Mode::off) return {};
  const char* unit = s.control.mode == Mode::speed      ? " rad/s"
                     : s.control.mode == Mode::position ? " deg"
                     : s.control.mode == Mode::current  ? " A"
                                                        : "";
  return "setpoint_limit = " + base::six_digits(largest_reference(s)) + unit +
         " is the largest reference of this scenario, and the drive limits its setpoint to this value; set [reference] to the largest setpoint of your firmware";
}

}  // namespace sixstep::study

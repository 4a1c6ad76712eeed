// SPDX-License-Identifier: Apache-2.0
#include "sixstep/study/run/export_notes.hpp"

#include <algorithm>
#include <cmath>

#include "sixstep/base/written.hpp"
#include "sixstep/design/sheet/sheet_check.hpp"
#include "sixstep/design/sheet/thermal.hpp"
#include "sixstep/study/check/check.hpp"
#include "sixstep/study/run/export_gate.hpp"
#include "sixstep/study/run/export_protection.hpp"
#include "sixstep/study/run/export_watch.hpp"
#include "sixstep/study/run/limit_remarks.hpp"
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

/// The first reason why the drive fails with a supply that cannot take current back.
std::string first_of(const base::Problems& found) {
  const base::Problem& p = found.front();
  return p.where + (p.value.empty() ? " " : " = " + p.value + " ") + p.limit;
}

}  // namespace

std::string limit_above_nominal(const Scenario& s, const design::MotorModel& motor) {
  const bool cascade = s.control.mode == Mode::speed || s.control.mode == Mode::position;
  const double nominal_A = motor.nominal_current_A;
  if (!cascade || s.control.drive == FirmwareKind::field || !(nominal_A > 0.0)) return {};
  const std::optional<MostCurrent> most = most_current(s, motor);
  // A limit that was set to the nominal current may differ from it by rounding.
  if (!most || !(most->ampere > 1.005 * nominal_A)) return {};
  const auto thermal = design::thermal_model(s.sheet);
  std::string stands = "; the sheet has no thermal values that say how long the winding withstands it";
  if (thermal) {
    // Copper loss with six-step commutation, where two phases carry the current.
    const double copper_W = 2 * motor.machine.R_ohm * most->ampere * most->ampere;
    const std::optional<double> stands_s = design::permissible_seconds(
        *thermal, {.copper_W = copper_W, .housing_W = 0.0, .ambient_degC = s.heat.ambient_degC});
    if (!stands_s) return {};
    stands = ": by the sheet's thermal values the winding withstands it for " + few_digits(*stands_s) +
             " s from " + few_digits(s.heat.ambient_degC) + " degC";
  }
  const bool linear = s.sheet.kind == design::MotorKind::linear;
  return most->by + " lets " + few_digits(most->ampere) + " A flow, " + few_digits(most->ampere / nominal_A) +
         " times the nominal current of " + few_digits(nominal_A) + " A" + stands +
         "; nothing in the drive ends that while " + (linear ? "the slide moves" : "the rotor turns") +
         ", so lower the limit unless the load is short";
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
        ": this stiff bus cannot rise; state supply.resistance_ohm, supply.capacitance_F and sinks = false "
        "if yours takes none";
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
    look_at_bus(other, peaks, s.sensors.bus == BusSensing::adc, found);
    if (found.empty()) look_at_stop(other, motor, listeners, found);
  }
  w.holds = found.empty();
  if (!w.holds) w.note = std::string(condition) + "; with one that takes none back " + first_of(found);
  return w;
}

std::string without_protection(const Scenario& s) {
  if (s.control.drive == FirmwareKind::product) return {};
  return "control.drive = \"" + std::string(base::word(drive_choices, s.control.drive)) +
         "\" has no protection: it leaves the bridge on at over-current, over-voltage and a stall; give your "
         "firmware one, or export control.drive = \"product\" with [protection]";
}

std::string setpoint_bound(const Scenario& s) {
  if (s.control.drive != FirmwareKind::product || s.control.mode == Mode::off) return {};
  const char* unit = s.control.mode == Mode::speed      ? " rad/s"
                     : s.control.mode == Mode::position ? " deg"
                     : s.control.mode == Mode::current  ? " A"
                                                        : "";
  return "setpoint_limit = " + base::six_digits(largest_reference(s)) + unit +
         " is the largest reference of this scenario, and the drive follows no larger setpoint; give "
         "[reference] the largest setpoint of your firmware";
}

}  // namespace sixstep::study

// SPDX-License-Identifier: Apache-2.0
#include "sixstep/study/run/export_gate.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "sixstep/base/decimal.hpp"
#include "sixstep/base/written.hpp"
#include "sixstep/design/sheet/parameters.hpp"
#include "sixstep/study/check/check.hpp"
#include "sixstep/study/check/pace.hpp"
#include "sixstep/study/run/export_notes.hpp"
#include "sixstep/study/run/export_protection.hpp"
#include "sixstep/study/run/export_watch.hpp"
#include "sixstep/study/run/loop_stability.hpp"
#include "sixstep/study/run/low_side_limits.hpp"
#include "sixstep/study/scenario/changes.hpp"
#include "sixstep/study/scenario/reference_waveform.hpp"
#include "sixstep/study/scenario/sensors_description.hpp"

namespace sixstep::study {
namespace {

using base::written;
using control::Mode;

/// True if comparators on the board limit the current, so that the drive needs no converter for the currents.
bool by_comparators(const Scenario& s) {
  const CurrentLoop& loop = s.control.current;
  return loop.type == CurrentLoopType::hysteresis && loop.comparator == Comparator::event;
}

bool is_cascade(const Scenario& s) {
  return s.control.mode == Mode::speed || s.control.mode == Mode::position;
}

bool has_current_loop(const Scenario& s) {
  return s.control.mode == Mode::current || (is_cascade(s) && s.control.speed.output == SpeedOutput::current);
}

bool reads_currents(const Scenario& s) {
  return (has_current_loop(s) && !by_comparators(s)) || s.control.smooth_chopping.on;
}

/// A field-oriented drive computes with the bus voltage and the rotor's angle.
bool in_the_field(const Scenario& s) {
  return s.control.drive == FirmwareKind::field && s.control.mode != Mode::off;
}

/// A sensorless drive measures its terminals relative to the bus.
bool by_terminals(const Scenario& s) {
  return s.control.drive == FirmwareKind::sensorless && s.control.mode != Mode::off;
}

bool reads_bus(const Scenario& s) {
  if (in_the_field(s) || by_terminals(s)) return true;
  return has_current_loop(s) && (s.control.current.measured_bus_from_V || s.control.regeneration.limit_V);
}

bool reads_rotor(const Scenario& s) {
  if (by_terminals(s)) return false;
  if (in_the_field(s) && s.control.field.angle != FieldAngle::sensors) return false;
  const bool within_current_loop = s.control.current.back_emf_feed_forward || s.control.limits.speed_rad_s;
  return is_cascade(s) || in_the_field(s) || (has_current_loop(s) && within_current_loop);
}

/// The keys that belong to the sensor of `s`: the check of `without`, which has no such sensor, reports them
/// as new problems. Empty if there are none.
std::string of_this_sensor(const Scenario& s, const Scenario& without) {
  const auto found = [](const Scenario& x) {
    base::Problems all = check_columns(x);
    append(all, check(x));
    return all;
  };
  const base::Problems before = found(s);
  std::vector<std::string> keys;
  for (const base::Problem& p : found(without)) {
    const std::string key = p.value.empty() ? p.where : p.where + " = " + p.value;
    const bool known = std::find(before.begin(), before.end(), p) != before.end();
    if (!known && std::find(keys.begin(), keys.end(), key) == keys.end()) keys.push_back(key);
  }
  std::string words;
  for (const std::string& key : keys) words += (words.empty() ? "" : ", ") + key;
  return words;
}

/// A cure that lists all changes needed to replace another sensor by Hall probes.
std::string cure_by_hall(const Scenario& s) {
  Scenario without = s;
  without.sensors.rotor = RotorSensing::hall;
  without.sensors.shaft = SensorShaft::motor;
  std::string cure = "set rotor = \"hall\"";
  if (s.sensors.shaft == SensorShaft::load) cure += " and shaft = \"motor\"";
  if (const std::string gone = of_this_sensor(s, without); !gone.empty())
    cure += ", remove the keys of the present sensor (" + gone + ")";
  if (!is_cascade(s)) return cure;
  const base::Result<design::MotorModel> motor = design::motor_model(s.sheet);
  const std::string step = motor ? base::three_digits(60.0 / motor->machine.pole_pairs) + " deg" : "a step";
  return cure + ", and design gains and [[require]] for Hall edges that are " + step + " apart";
}

void look_at_sensors(const Scenario& s, base::Problems& out) {
  const auto ideal = [&out](const char* key, const char* what, const std::string& cure) {
    out.push_back({key, "\"ideal\"", std::string("gives the drive ") + what, cure});
  };
  if (reads_rotor(s) && s.sensors.rotor == RotorSensing::ideal)
    ideal("sensors.rotor",
          in_the_field(s)
              ? "the exact angle and speed at every instant, and a board has only the values of a decoder"
              : "the exact speed and position at every instant, and a board has only Hall edges",
          in_the_field(s)
              ? "set rotor = \"encoder\", \"absolute\" or \"resolver\", or \"hall\" with hall_angle"
              : cure_by_hall(s));
  if (!in_the_field(s) && s.sensors.rotor != RotorSensing::ideal && s.sensors.rotor != RotorSensing::hall)
    out.push_back({"sensors.rotor",
                   '"' + std::string(base::word(rotor_sensing_choices, s.sensors.rotor)) + '"',
                   "is not supported by the header's drive, which reads Hall probes", cure_by_hall(s)});
  if (reads_currents(s) && s.sensors.currents == rig::CurrentMeasurement::ideal)
    ideal(
        "sensors.currents", "phase currents without the errors of amplifier and converter",
        in_the_field(s)
            ? "set sensors.currents = \"phases\" or \"low-side\", and give sensors.current_range_A"
            : "set sensors.currents = \"phases\", \"dc-link\" or \"low-side\", and give sensors.current_range_A");
  if (reads_bus(s) && s.sensors.bus == BusSensing::ideal)
    ideal("sensors.bus", "a bus voltage without the errors of a converter",
          "set sensors.bus = \"adc\" and give sensors.bus_range_V");
}

void look_at_design(const Scenario& s, base::Problems& out) {
  if (!s.not_usable.empty())
    out.push_back({"not_usable", "", "was set by the design: " + s.not_usable,
                   "design the loops again, and remove the line not_usable if the new design is usable"});
}

/// The output computed from a sample in the middle of a period takes effect at the next period's start. This
/// delay of half a period is realistic without delay_periods.
void look_at_delay(const Scenario& s, base::Problems& out) {
  const bool samples = reads_currents(s) || reads_bus(s) || reads_rotor(s);
  if (samples && !by_comparators(s) && s.pwm.delay_periods == 0 && s.pwm.sample == SampleAt::start)
    out.push_back(
        {"pwm.delay_periods", "0",
         "lets the command act at the instant of the sample, but a chip needs time to convert and compute",
         "set delay_periods = 1, or sample = \"middle\""});
}

/// Turn-off time of a MOSFET, s: the gate driver removes the gate charge while the voltage rises and the
/// current falls. 0: not given.
double turn_off_s(const Bridge& b) {
  return b.gate_current_A > 0 ? (b.gate_source_charge_C + b.gate_drain_charge_C) / b.gate_current_A : 0.0;
}

/// Applies to every drive: when the torque reverses, a leg changes from one switch to the other, with every
/// kind of chopping.
void look_at_dead_time(const Scenario& s, base::Problems& out) {
  constexpr double shortest_s = 20e-9;  // two clock periods of a fast timer; no switch turns off faster
  if (s.control.mode == Mode::off) return;
  const double counted_s = dead_time_in_counts_s(s.bridge.dead_time_s, s.pwm), own_s = turn_off_s(s.bridge);
  const auto refuse = [&](const std::string& limit) {
    out.push_back(
        {"bridge.dead_time_s", written(s.bridge.dead_time_s), limit,
         "give the gate drivers' dead time, for example " +
             base::rounded(1e9 * base::shortened(std::fmax(500e-9, 1.2 * own_s), 2, base::Towards::up), 3) +
             "e-9"});
  };
  if (!(s.bridge.dead_time_s > 0))
    refuse("turns one switch of a leg on while the other turns off, and real switches then short the bus");
  else if (counted_s < std::fmax(shortest_s, own_s))
    refuse(own_s > shortest_s
               ? "ends before the other switch is off: the driver needs " + base::three_digits(1e9 * own_s) +
                     " ns for gate_source_charge_C + gate_drain_charge_C at gate_current_A"
               : "is below 20e-9, and no switch turns off within 20 ns");
}

/// Refuses events that change the drive's constants or the dead time: a chip keeps the exported constants.
void look_at_changes(const Scenario& s, base::Problems& out) {
  for (std::size_t n = 0; n < s.at.size(); ++n) {
    const auto changes = [&](const char* what) {
      out.push_back(
          {"at[" + std::to_string(n) + "]", "at " + written(s.at[n].time_s) + " s",
           std::string("changes ") + what + ", but a header contains only the configuration at the start",
           "remove the change, or export a scenario that begins with the changed values"});
    };
    if (retunes(s.at[n])) changes("the drive's settings");
    if (s.at[n].bridge.dead_time_s) changes("the dead time");
  }
}

std::string required(const Verdict& v) {
  const std::string unit = v.unit.empty() ? "" : " " + v.unit;
  if (v.min && v.max) return written(*v.min) + " .. " + written(*v.max) + unit;
  if (v.min) return ">= " + written(*v.min) + unit;
  return v.max ? "<= " + written(*v.max) + unit : "";
}

/// The measured value with enough digits to differ from the missed limit.
std::string measured(const Verdict& v) {
  std::string text;
  for (int digits = 5; digits <= 17; ++digits) {
    text = base::rounded(v.measured, digits);
    const auto looks_like = [&](const std::optional<double>& limit) {
      return limit && text == base::rounded(*limit, digits);
    };
    if (!looks_like(v.min) && !looks_like(v.max)) break;
  }
  return v.unit.empty() ? text : text + " " + v.unit;
}

}  // namespace

base::Problems never_measured(const Scenario& s) {
  base::Problems out;
  look_at_design(s, out);
  look_at_sensors(s, out);
  look_at_delay(s, out);
  look_at_dead_time(s, out);
  look_at_changes(s, out);
  if (const auto motor = design::motor_model(s.sheet); motor && s.control.drive == FirmwareKind::product)
    look_at_protection(s, *motor, out);
  if (s.require.empty())
    out.push_back({"require", "", "is missing: a run without requirements proves nothing",
                   "give the drive's requirements in [[require]]; the help on require explains its keys"});
  return out;
}

base::Problems not_held(const Outcome& outcome) {
  base::Problems out;
  if (outcome.fault) out.push_back(*outcome.fault);
  for (const Verdict& v : outcome.verdicts)
    if (!v.ok)
      out.push_back(
          {v.figure, std::isfinite(v.measured) ? measured(v) : "",
           (std::isfinite(v.measured) ? "misses its requirement, " : "never reached its requirement, ") +
               required(v),
           "find the cause in the run's report, and change the loops or the requirement"});
  return out;
}

namespace {

/// Notes that the run's own remarks do not contain.
void add_notes(const Scenario& s, const Listeners& listeners, Clearance& c) {
  const auto add = [&c](std::string note) {
    const auto& said = c.outcome.remarks;
    if (!note.empty() && std::find(said.begin(), said.end(), note) == said.end())
      c.notes.push_back(std::move(note));
  };
  add(sheet_contradiction(s));
  add(limit_above_nominal(s, c.outcome.motor));
  for (std::string& text : unchecked(s, c.outcome.motor)) add(std::move(text));
  add(setpoint_bound(s));
  add(short_dead_time(s));
  add(low_side_limits(s));
  add(without_protection(s));
  // Conditions apply only to a scenario that is cleared for export.
  if (!c.clear()) return;
  WithoutSink other = without_sink(s, c.outcome.motor, listeners);
  c.needs_sink = other.matters && !other.holds;
  add(std::move(other.note));
}

}  // namespace

base::Result<Clearance> clear_for_export(const Scenario& scenario, const Listeners& listeners) {
  if (scenario.sheet.kind == design::MotorKind::linear)
    return base::Problem{"motor", "\"" + scenario.motor + "\"",
                         "is a linear motor, and a header supports only rotary motors",
                         "copy the gains from the run's report"};
  base::Result<Outcome> outcome = run(watching_peaks(scenario), listeners);
  if (!outcome) return outcome.problems();
  Clearance c{
      .outcome = std::move(*outcome), .unmeasured = never_measured(scenario), .unheld = {}, .notes = {}};
  const SeenPeaks peaks = take_peaks(scenario, c.outcome);
  c.unheld = not_held(c.outcome);
  // The rotor's inertia hides an unstable current loop from requirements on the speed.
  for (const LoopGains& gains : c.outcome.gains)
    if (auto unstable = unstable_current_loop(scenario, c.outcome.motor, gains))
      c.unheld.push_back(std::move(*unstable));
  if (reads_currents(scenario)) look_at_current_range(scenario, peaks, c.unheld);
  look_at_bus(scenario, peaks, reads_bus(scenario), listeners, c.unheld);
  if (c.unheld.empty()) look_at_stop(scenario, c.outcome.motor, listeners, c.unheld);
  add_notes(scenario, listeners, c);
  return c;
}

}  // namespace sixstep::study

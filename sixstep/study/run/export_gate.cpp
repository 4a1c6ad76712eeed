// SPDX-License-Identifier: Apache-2.0
#include "sixstep/study/run/export_gate.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "sixstep/base/written.hpp"
#include "sixstep/design/sheet/parameters.hpp"
#include "sixstep/study/check/check.hpp"
#include "sixstep/study/check/product.hpp"
#include "sixstep/study/scenario/changes.hpp"
#include "sixstep/study/scenario/reference_waveform.hpp"
#include "sixstep/study/scenario/sensors_description.hpp"

namespace sixstep::study {
namespace {

using base::written;
using control::Mode;

/// Comparators on the board switch at once, and look at currents that nobody converts.
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

/// Three legs go by the bus, and turn by the rotor's angle.
bool in_the_field(const Scenario& s) {
  return s.control.drive == FirmwareKind::field && s.control.mode != Mode::off;
}

/// Its terminals are read against the bus.
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

/// What is of the sensor that goes, by its keys: found by asking for the scenario without it. Empty where nothing is.
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

/// All that has to change for Hall probes in the place of another sensor, at once.
std::string cure_by_hall(const Scenario& s) {
  Scenario without = s;
  without.sensors.rotor = RotorSensing::hall;
  without.sensors.shaft = SensorShaft::motor;
  std::string cure = "set rotor = \"hall\"";
  if (s.sensors.shaft == SensorShaft::load) cure += " and shaft = \"motor\"";
  if (const std::string gone = of_this_sensor(s, without); !gone.empty())
    cure += ", leave out what is of the other sensor (" + gone + ")";
  if (!is_cascade(s)) return cure;
  const base::Result<design::MotorModel> motor = design::motor_model(s.sheet);
  const std::string step = motor ? base::three_digits(60.0 / motor->machine.pole_pairs) + " deg" : "a step";
  return cure + ", and have gains and [[require]] designed for edges that come " + step + " apart";
}

void look_at_sensors(const Scenario& s, base::Problems& out) {
  const auto ideal = [&out](const char* key, const char* what, const std::string& cure) {
    out.push_back({key, "\"ideal\"", std::string("tells the drive ") + what, cure});
  };
  if (reads_rotor(s) && s.sensors.rotor == RotorSensing::ideal)
    ideal("sensors.rotor",
          in_the_field(s) ? "angle and speed at every instant, and a board has a decoder's"
                          : "speed and position at every instant, and a board has the Hall edges",
          in_the_field(s)
              ? "set rotor = \"encoder\", \"absolute\" or \"resolver\", or \"hall\" with hall_angle"
              : cure_by_hall(s));
  if (!in_the_field(s) && s.sensors.rotor != RotorSensing::ideal && s.sensors.rotor != RotorSensing::hall)
    out.push_back({"sensors.rotor",
                   '"' + std::string(base::word(rotor_sensing_choices, s.sensors.rotor)) + '"',
                   "has no decoder in the header's drive, which reads Hall probes", cure_by_hall(s)});
  if (reads_currents(s) && s.sensors.currents == rig::CurrentMeasurement::ideal)
    ideal("sensors.currents", "currents that no amplifier and converter have been through",
          in_the_field(s) ? "set currents = \"phases\" and current_range_A"
                          : "set currents = \"phases\" or \"dc-link\", and current_range_A");
  if (reads_bus(s) && s.sensors.bus == BusSensing::ideal)
    ideal("sensors.bus", "a bus voltage that no converter has been through",
          "set bus = \"adc\" and bus_range_V");
}

/// A controller of one's own has its constants at home.
void look_at_drive(const Scenario& s, base::Problems& out) {
  if (s.control.drive == FirmwareKind::own)
    out.push_back({"control.drive", "\"own\"", "has its configuration in its own source, and needs no header",
                   "compile that source for the chip"});
}

/// What is sampled in the middle of a period is answered at the next one's start: that is a delay.
void look_at_delay(const Scenario& s, base::Problems& out) {
  const bool samples = reads_currents(s) || reads_bus(s) || reads_rotor(s);
  if (samples && !by_comparators(s) && s.pwm.delay_periods == 0 && s.pwm.sample == SampleAt::start)
    out.push_back({"pwm.delay_periods", "0",
                   "answers a sample at the instant it is taken, and a chip has to convert and compute first",
                   "set delay_periods = 1, or sample = \"middle\""});
}

/// Of every drive: where the torque reverses, a leg changes over from one switch to the other, whichever way it is chopped.
void look_at_dead_time(const Scenario& s, base::Problems& out) {
  constexpr double shortest_s = 20e-9;  // two clocks of a fast timer; no switch turns off sooner
  if (s.control.mode != Mode::off && s.bridge.dead_time_s > 0 && s.bridge.dead_time_s < shortest_s)
    out.push_back({"bridge.dead_time_s", written(s.bridge.dead_time_s),
                   "is over before any switch is off: less than 20e-9",
                   "give what the gate drivers need, as 500e-9"});
  if (s.control.mode != Mode::off && !(s.bridge.dead_time_s > 0))
    out.push_back({"bridge.dead_time_s", written(s.bridge.dead_time_s),
                   "turns one switch of a leg on while the other turns off, and real ones short the bus then",
                   "give what the gate drivers need, as 500e-9"});
}

/// A chip keeps the constants that were written for it, and the bridge its dead time.
void look_at_changes(const Scenario& s, base::Problems& out) {
  for (std::size_t n = 0; n < s.at.size(); ++n) {
    const auto changes = [&](const char* what) {
      out.push_back(
          {"at[" + std::to_string(n) + "]", "at " + written(s.at[n].time_s) + " s",
           std::string("changes ") + what + ", and what is written is the configuration of the start",
           "take the change out, or run a scenario that begins with it and export that"});
    };
    if (retunes(s.at[n])) changes("how the drive is set");
    if (s.at[n].bridge.dead_time_s) changes("the dead time");
  }
}

std::string required(const Verdict& v) {
  const std::string unit = v.unit.empty() ? "" : " " + v.unit;
  if (v.min && v.max) return written(*v.min) + " .. " + written(*v.max) + unit;
  if (v.min) return ">= " + written(*v.min) + unit;
  return v.max ? "<= " + written(*v.max) + unit : "";
}

/// In as many digits as tell it from the limit that it misses.
std::string measured(const Verdict& v) {
  if (!std::isfinite(v.measured)) return "never";
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

bool converts_currents(const Scenario& s) {
  return reads_currents(s) && s.sensors.currents != rig::CurrentMeasurement::ideal &&
         s.sensors.current_range_A;
}

/// The extremes of all phases, behind what the scenario compares.
void watch_currents(Scenario& s) {
  for (const Signal phase : {Signal::phase_a, Signal::phase_b, Signal::phase_c})
    for (const MetricKind end : {MetricKind::minimum, MetricKind::maximum}) {
      Measure m;
      m.metric = end;
      m.signal = phase;
      s.compare.push_back({m, 0.0, ""});
    }
}

/// The greatest of them; the outcome is then as of the scenario itself.
double take_peak(const Scenario& s, Outcome& outcome) {
  double peak = 0.0;
  for (; outcome.comparisons.size() > s.compare.size(); outcome.comparisons.pop_back())
    peak = std::fmax(peak, std::fabs(outcome.comparisons.back().measured));
  return peak;
}

/// What flows above the converter's end, the drive neither sees nor limits.
void look_at_range(const Scenario& s, double peak_A, base::Problems& out) {
  if (!converts_currents(s)) return;
  const double range = *s.sensors.current_range_A;
  const double end =
      range - 2 * range / std::ldexp(1.0, s.sensors.adc_bits) - std::fabs(s.sensors.current_offset_A);
  if (peak_A < end) return;
  out.push_back({"sensors.current_range_A", written(range),
                 "was left by the run: " + base::three_digits(peak_A) +
                     " A flowed, and the converter ends at " + base::three_digits(end) +
                     " A, beyond which the drive sees nothing",
                 "widen it, or lower what the drive asks for"});
}

/// How long it brakes at most: from no-load speed, with half as much again for friction that drives.
double braking_s(const Scenario& s, const design::MotorModel& motor) {
  constexpr double shortest = 20e-3, longest = 2.0;
  const double w = s.supply.voltage_V / motor.K_t_Nm_A, J = motor.shaft.J_kg_m2 + s.load.inertia_kg_m2;
  return std::clamp(1.5 * J * w / (motor.K_t_Nm_A * s.protection.brake_current_A), shortest, longest);
}

/// The end of the level at which most is asked for.
double end_of_the_highest(const Scenario& s) {
  const std::vector<Level> levels = reference_levels(s);
  std::size_t highest = 0;
  for (std::size_t n = 0; n < levels.size(); ++n)
    if (levels[n].at_s < s.duration_s && std::fabs(levels[n].value) > std::fabs(levels[highest].value))
      highest = n;
  return highest + 1 < levels.size() ? std::min(levels[highest + 1].at_s, s.duration_s) : s.duration_s;
}

/// A drive that brakes when it is let go does so on the first bench: here at its highest setpoint, unless the scenario lets it go.
void run_the_stop(const Scenario& s, const Listeners& listeners, Clearance& c) {
  if (s.control.drive != FirmwareKind::product || !(s.protection.brake_current_A > 0) ||
      s.protection.off_at_s)
    return;
  Scenario stop = s;
  const double off_s = end_of_the_highest(s);
  stop.protection.off_at_s = off_s;
  stop.duration_s = std::max(s.duration_s, off_s + braking_s(s, c.outcome.motor));
  if (stop.duration_s == off_s) return;
  stop.require.clear();
  stop.compare.clear();
  const base::Result<Outcome> out =
      run(stop, {.on_record = {}, .on_event = {}, .keep_going = listeners.keep_going, .keep_books = false});
  if (!out) return append(c.unheld, out.problems());
  if (!out->trip) return;
  std::string reasons;
  for (const std::string& reason : out->trip->reasons) reasons += (reasons.empty() ? "" : ", ") + reason;
  c.unheld.push_back({"protection.brake_current_A", written(s.protection.brake_current_A),
                      "ends in a fault where the drive is let go at " + base::rounded(off_s, 4) + " s: " +
                          reasons + " after " + base::three_digits(1e3 * (out->trip->at_s - off_s)) + " ms",
                      "lower it, or let the scenario show the stop: protection.off_at_s"});
}

}  // namespace

base::Problems never_measured(const Scenario& s) {
  base::Problems out;
  look_at_drive(s, out);
  look_at_sensors(s, out);
  look_at_delay(s, out);
  look_at_dead_time(s, out);
  look_at_changes(s, out);
  if (const auto motor = design::motor_model(s.sheet); motor && s.control.drive == FirmwareKind::product)
    look_at_stalling(s, *motor, out);
  if (s.require.empty())
    out.push_back({"require", "", "is missing: where nothing is asked of a run, nothing has been shown",
                   "say in [[require]] what the drive must do; see the help on require"});
  return out;
}

base::Problems not_held(const Outcome& outcome) {
  base::Problems out;
  if (outcome.fault) out.push_back(*outcome.fault);
  for (const Verdict& v : outcome.verdicts)
    if (!v.ok)
      out.push_back({v.figure, measured(v), "misses what is required, " + required(v),
                     "look at its report, and change the drive"});
  return out;
}

base::Result<Clearance> clear_for_export(const Scenario& scenario, const Listeners& listeners) {
  if (scenario.sheet.kind == design::MotorKind::linear)
    return base::Problem{"motor", "\"" + scenario.motor + "\"",
                         "is linear, and a header speaks of turning motors only",
                         "take the gains from the run's report"};
  Scenario watched = scenario;
  if (converts_currents(scenario)) watch_currents(watched);
  base::Result<Outcome> outcome = run(watched, listeners);
  if (!outcome) return outcome.problems();
  Clearance c{.outcome = std::move(*outcome), .unmeasured = never_measured(scenario), .unheld = {}};
  const double peak_A = take_peak(scenario, c.outcome);
  c.unheld = not_held(c.outcome);
  look_at_range(scenario, peak_A, c.unheld);
  if (c.unheld.empty()) run_the_stop(scenario, listeners, c);
  return c;
}

}  // namespace sixstep::study

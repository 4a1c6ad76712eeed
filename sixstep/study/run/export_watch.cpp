// SPDX-License-Identifier: Apache-2.0
#include "sixstep/study/run/export_watch.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "sixstep/base/written.hpp"
#include "sixstep/study/check/converter_ends.hpp"
#include "sixstep/study/scenario/reference_waveform.hpp"
#include "sixstep/study/scenario/supply_voltages.hpp"

namespace sixstep::study {
namespace {

using base::written;

constexpr Signal phases[] = {Signal::phase_a, Signal::phase_b, Signal::phase_c};

void watch(MetricKind metric, Signal signal, Scenario& s) {
  Measure m;
  m.metric = metric;
  m.signal = signal;
  s.compare.push_back({m, 0.0, ""});
}

/// The highest bus voltage in V that the scenario itself allows.
double allowed_bus_V(const Scenario& s) {
  double allowed = risen_part * highest_open_V(s);
  allowed = std::fmax(allowed, s.protection.over_voltage_V.value_or(0.0));
  allowed = std::fmax(allowed, risen_part * s.control.regeneration.limit_V.value_or(0.0));
  if (s.supply.brake_resistance_ohm > 0) allowed = std::fmax(allowed, risen_part * s.supply.brake_on_V);
  for (const Requirement& r : s.require)
    if (r.measure.signal == Signal::bus_voltage && r.measure.metric == MetricKind::maximum && r.max)
      allowed = std::fmax(allowed, *r.max);
  return allowed;
}

/// Longest braking time from no-load speed, s. The factor 1.5 allows for a load torque that drives the rotor.
double braking_s(const Scenario& s, const design::MotorModel& motor) {
  constexpr double shortest = 20e-3, longest = 2.0;
  const double w = s.supply.voltage_V / motor.K_t_Nm_A, J = motor.shaft.J_kg_m2 + s.load.inertia_kg_m2;
  return std::clamp(1.5 * J * w / (motor.K_t_Nm_A * s.protection.brake_current_A), shortest, longest);
}

/// The end in s of the reference's level with the largest magnitude.
double end_of_the_highest(const Scenario& s) {
  const std::vector<Level> levels = reference_levels(s);
  std::size_t highest = 0;
  for (std::size_t n = 0; n < levels.size(); ++n)
    if (levels[n].at_s < s.duration_s && std::fabs(levels[n].value) > std::fabs(levels[highest].value))
      highest = n;
  return highest + 1 < levels.size() ? std::min(levels[highest + 1].at_s, s.duration_s) : s.duration_s;
}

std::string reasons_of(const Trip& trip) {
  std::string reasons;
  for (const std::string& reason : trip.reasons) reasons += (reasons.empty() ? "" : ", ") + reason;
  return reasons;
}

/// The highest bus voltage, V, until the phase currents have ended after a trip. Until then braking or the
/// windings' energy raises the bus, later only a load that drives the rotor.
double bus_until_the_trip_V(const Scenario& scenario, const Trip& trip, const Listeners& listeners) {
  constexpr double currents_end_s = 10e-3;
  Scenario s = scenario;
  s.require.clear();
  s.compare.clear();
  watch(MetricKind::maximum, Signal::bus_voltage, s);
  s.compare.back().measure.to_s = trip.at_s + currents_end_s;
  const base::Result<Outcome> until =
      run(s, {.on_record = {}, .on_event = {}, .keep_going = listeners.keep_going, .keep_books = false});
  return until && !until->comparisons.empty() ? until->comparisons.front().measured : HUGE_VAL;
}

base::Problem raised_after(const Scenario& s, const Trip& trip, const std::string& bus) {
  const bool turned = !s.load.locked && s.load.torque_Nm != 0.0;
  return {"the bus", bus + " V",
          "was reached after the trip at " + base::rounded(trip.at_s, 4) + " s (" + reasons_of(trip) +
              ") with the bridge off: " +
              (turned ? "load.torque_Nm = " + written(s.load.torque_Nm) +
                            " turns the shaft, as a hanging weight does"
                      : std::string("the load turns the shaft")) +
              ", and the back-EMF feeds the bus through the diodes",
          std::string("change the scenario so that the drive does not trip") +
              (turned ? "; for a load that does not turn the shaft use load.coulomb_Nm" : "")};
}

/// A weaker brake feeds less power into the bus, for a longer time.
std::string cure_of_stop(const std::vector<std::string>& reasons) {
  if (std::find(reasons.begin(), reasons.end(), "over-voltage") == reasons.end())
    return "lower protection.brake_current_A, or add protection.off_at_s, so that the run shows the stop";
  return "give supply.brake_resistance_ohm with brake_on_V below protection.over_voltage_V, "
         "control.regeneration.limit_V or more supply.capacitance_F";
}

}  // namespace

Scenario watching_peaks(const Scenario& scenario) {
  Scenario s = scenario;
  for (const Signal phase : phases)
    for (const MetricKind end : {MetricKind::minimum, MetricKind::maximum}) watch(end, phase, s);
  watch(MetricKind::maximum, Signal::bus_voltage, s);
  return s;
}

SeenPeaks take_peaks(const Scenario& scenario, Outcome& outcome) {
  SeenPeaks e{.trip = outcome.trip};
  const std::size_t own = scenario.compare.size();
  for (std::size_t n = own; n < outcome.comparisons.size(); ++n) {
    const double x = outcome.comparisons[n].measured;
    if (n + 1 < outcome.comparisons.size())
      e.phase_A = std::fmax(e.phase_A, std::fabs(x));
    else
      e.bus_V = x;
  }
  outcome.comparisons.resize(std::min(own, outcome.comparisons.size()));
  return e;
}

void look_at_current_range(const Scenario& s, const SeenPeaks& peaks, base::Problems& out) {
  if (s.sensors.currents == rig::CurrentMeasurement::ideal || !s.sensors.current_range_A) return;
  const double end = current_end_A(s.sensors);
  if (peaks.phase_A < end) return;
  out.push_back({"sensors.current_range_A", written(*s.sensors.current_range_A),
                 "was exceeded in the run: " + base::three_digits(peaks.phase_A) +
                     " A flowed, and the converter measures only up to " + base::three_digits(end) + " A",
                 "raise this value, or lower control.current.limit_A"});
}

void look_at_bus(const Scenario& s, const SeenPeaks& peaks, bool is_read, const Listeners& listeners,
                 base::Problems& out) {
  const std::string bus = base::three_digits(peaks.bus_V);
  if (is_read && s.sensors.bus == BusSensing::adc && s.sensors.bus_range_V) {
    const double end = bus_end_V(s.sensors);
    if (!(peaks.bus_V < end))
      out.push_back({"sensors.bus_range_V", written(*s.sensors.bus_range_V),
                     "was exceeded in the run: the bus reached " + bus +
                         " V, and the converter measures only up to " + base::three_digits(end) + " V",
                     "raise this value, or set control.regeneration.limit_V"});
  }
  if (peaks.bus_V <= allowed_bus_V(s)) return;
  if (peaks.trip && bus_until_the_trip_V(s, *peaks.trip, listeners) < 0.99 * peaks.bus_V)
    return out.push_back(raised_after(s, *peaks.trip, bus));
  out.push_back(
      {"the bus", bus + " V",
       "was raised by braking, from " + base::three_digits(highest_open_V(s)) +
           " V, and nothing limits the bus voltage",
       "give supply.brake_resistance_ohm, control.regeneration.limit_V or more supply.capacitance_F, or allow this maximum of bus_voltage in [[require]]"});
}

void look_at_stop(const Scenario& s, const design::MotorModel& motor, const Listeners& listeners,
                  base::Problems& out) {
  if (s.control.drive != FirmwareKind::product || !(s.protection.brake_current_A > 0) ||
      s.protection.off_at_s)
    return;
  Scenario stop = s;
  const double off_s = end_of_the_highest(s);
  stop.protection.off_at_s = off_s;
  stop.duration_s = std::max(s.duration_s, off_s + braking_s(s, motor));
  if (stop.duration_s == off_s) return;
  stop.require.clear();
  stop.compare.clear();
  base::Result<Outcome> outcome =
      run(watching_peaks(stop),
          {.on_record = {}, .on_event = {}, .keep_going = listeners.keep_going, .keep_books = false});
  if (!outcome) return append(out, outcome.problems());
  const SeenPeaks peaks = take_peaks(stop, *outcome);
  // Braking does not raise the speed. A driving load can raise it after the bridge has turned off, so that
  // over-speed alone is no reason.
  if (!outcome->trip || outcome->trip->reasons == std::vector<std::string>{"over-speed"}) return;
  const std::string reasons = reasons_of(*outcome->trip);
  out.push_back({"protection.brake_current_A", written(s.protection.brake_current_A),
                 "ends a stop at " + base::rounded(off_s, 4) + " s in a fault: " + reasons + " after " +
                     base::three_digits(1e3 * (outcome->trip->at_s - off_s)) + " ms, the bus at " +
                     base::three_digits(peaks.bus_V) + " V at most",
                 cure_of_stop(outcome->trip->reasons)});
}

}  // namespace sixstep::study

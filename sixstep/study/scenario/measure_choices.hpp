// SPDX-License-Identifier: Apache-2.0
// The words for figures and signals, in files and in results, and what they mean.
#pragma once
#include <array>
#include <iterator>
#include <string_view>

#include "sixstep/base/describe.hpp"
#include "sixstep/study/scenario/measure.hpp"

namespace sixstep::study {

inline constexpr base::Choice<MetricKind> metric_choices[] = {
    {"final", MetricKind::final_value, "value at the end of the window"},
    {"mean", MetricKind::mean, "mean over the window"},
    {"rms", MetricKind::rms, "root of the mean square over the window"},
    {"max", MetricKind::maximum, "largest value in the window"},
    {"min", MetricKind::minimum, "smallest value in the window"},
    {"peak_to_peak", MetricKind::peak_to_peak, "largest less smallest value in the window"},
    {"ripple_rms", MetricKind::ripple_rms, "rms of what is left of the signal without its mean"},
    {"overshoot", MetricKind::overshoot, "how far the signal goes beyond level, in the signal's unit"},
    {"reach_time_s", MetricKind::reach_time,
     "time until the signal first gets to start + fraction (level - start); without level: the slowest over "
     "all steps of the reference"},
    {"rise_time_s", MetricKind::rise_time,
     "time from 10 % to 90 % of the way from start to level; without level: the slowest over all steps of "
     "the "
     "reference"},
    {"settling_time_s", MetricKind::settling_time,
     "time of the last exit from level +- band |level - start|, counted from from_s; of samples: of the "
     "first "
     "one from which on all lie inside"},
    {"steady_error", MetricKind::steady_error,
     "mean of level - signal; without level: of reference - signal at the end of each of the reference's "
     "levels, the largest by size"},
    {"largest_error", MetricKind::largest_error,
     "largest distance of the signal from level: half width of the band it keeps; without level as for "
     "steady_error"},
    {"thd", MetricKind::thd,
     "total harmonic distortion: rms of all but mean and fundamental, over the rms of the fundamental; over "
     "whole electrical turns, or whole periods of frequency_Hz"},
    {"energy_J", MetricKind::energy, "energy over the window of a power or a loss"},
    {"efficiency", MetricKind::efficiency,
     "energy given to load and inertia over energy taken from the bus; while braking the other way round"},
    {"band_excess_A", MetricKind::band_excess, "largest excess above the upper limit of the hysteresis band"},
    {"band_deficit_A", MetricKind::band_deficit,
     "largest shortfall below the lower limit, except from a sector edge or reference step until the current "
     "is back in the band"},
    {"switching_frequency_Hz", MetricKind::switching_frequency,
     "turn-ons per second in the window: of what is chopped, or of one switch with signal = \"gate_T1\""},
};

/// One row per signal. `phrase` stands behind a figure's name: "mean line voltage a to b".
struct SignalFact {
  Signal signal;
  std::string_view word;
  std::string_view phrase;
  std::string_view unit;
  std::string_view meaning;
};

/// A signal that is a column of the trace by another word carries the column's own name.
inline constexpr SignalFact signal_facts[] = {
    {Signal::current, "current", "motor current", "A", "motor current (i_p - i_n)/2 of the positive pair, A"},
    {Signal::phase_a, "i_a", "current of phase a", "A", "current into phase a, A"},
    {Signal::phase_b, "i_b", "current of phase b", "A", "current into phase b, A"},
    {Signal::phase_c, "i_c", "current of phase c", "A", "current into phase c, A"},
    {Signal::current_magnitude, "current_magnitude", "half the sum of current magnitudes", "A",
     "half the sum of the phase currents' magnitudes, A"},
    {Signal::speed, "speed", "speed", "rad/s", "mechanical speed, rad/s"},
    {Signal::position, "position", "position", "deg", "mechanical angle counted over turns, deg"},
    {Signal::torque, "torque", "torque", "N m", "electromagnetic torque, N m"},
    {Signal::bus_voltage, "bus_voltage", "bus voltage", "V", "voltage of the bus, V"},
    {Signal::bus_current, "bus_current", "bus current", "A", "current from the bus into the bridge, A"},
    {Signal::pole_a, "u_a_V", "voltage of terminal a", "V",
     "voltage of terminal a against the negative rail"},
    {Signal::pole_b, "u_b_V", "voltage of terminal b", "V",
     "voltage of terminal b against the negative rail"},
    {Signal::pole_c, "u_c_V", "voltage of terminal c", "V",
     "voltage of terminal c against the negative rail"},
    {Signal::line_ab, "u_ab_V", "line voltage a to b", "V", "line voltage a to b"},
    {Signal::line_bc, "u_bc_V", "line voltage b to c", "V", "line voltage b to c"},
    {Signal::line_ca, "u_ca_V", "line voltage c to a", "V", "line voltage c to a"},
    {Signal::emf_a, "e_a_V", "back-EMF of phase a", "V", "back-EMF of phase a"},
    {Signal::emf_b, "e_b_V", "back-EMF of phase b", "V", "back-EMF of phase b"},
    {Signal::emf_c, "e_c_V", "back-EMF of phase c", "V", "back-EMF of phase c"},
    {Signal::angle, "angle_rad", "angle", "rad", "mechanical angle counted over turns"},
    {Signal::duty, "duty", "duty", "1",
     "signed duty in effect; with armed comparators the state of the upper switch"},
    {Signal::current_reference, "i_ref_A", "current reference", "A", "current reference at the last sample"},
    {Signal::speed_reference, "speed_ref_rad_s", "speed reference", "rad/s",
     "speed reference at the last sample"},
    {Signal::position_reference, "position_ref_deg", "position reference", "deg", "position setpoint"},
    {Signal::current_error, "current_error_A", "current error", "A", "current reference less motor current"},
    {Signal::speed_error, "speed_error_rad_s", "speed error", "rad/s", "speed reference less speed"},
    {Signal::position_error, "position_error_deg", "position error", "deg",
     "position setpoint less position"},
    {Signal::load_torque, "load_Nm", "load torque", "N m", "load torque"},
    {Signal::gate_T1, "gate_T1", "gate T1", "1", "upper gate of a, 1 while on: its mean is its duty"},
    {Signal::gate_T2, "gate_T2", "gate T2", "1", "lower gate of a"},
    {Signal::gate_T3, "gate_T3", "gate T3", "1", "upper gate of b"},
    {Signal::gate_T4, "gate_T4", "gate T4", "1", "lower gate of b"},
    {Signal::gate_T5, "gate_T5", "gate T5", "1", "upper gate of c"},
    {Signal::gate_T6, "gate_T6", "gate T6", "1", "lower gate of c"},
    {Signal::supply_power, "supply_power_W", "power from the bus", "W",
     "bus voltage times bus current: power into the bridge"},
    {Signal::motor_power, "motor_power_W", "power into the motor", "W",
     "electrical power into the motor's terminals"},
    {Signal::mechanical_power, "mechanical_power_W", "mechanical power", "W",
     "torque times speed: power that the air gap converts"},
    {Signal::load_power, "load_power_W", "power to the load torque", "W", "load torque times speed"},
    {Signal::copper_loss, "copper_loss_W", "copper loss", "W", "R_s (i_a^2 + i_b^2 + i_c^2)"},
    {Signal::device_loss, "device_loss_W", "device loss", "W", "conduction loss of switches and diodes"},
    {Signal::friction_loss, "friction_loss_W", "friction loss", "W",
     "viscous and dry friction of motor and load together"},
};

/// Columns of the trace that have an older word.
inline constexpr base::Choice<Signal> column_words[] = {
    {"i_m_A", Signal::current, "the same as current"},
    {"i_a_A", Signal::phase_a, "the same as i_a"},
    {"i_b_A", Signal::phase_b, "the same as i_b"},
    {"i_c_A", Signal::phase_c, "the same as i_c"},
    {"speed_rad_s", Signal::speed, "the same as speed"},
    {"torque_Nm", Signal::torque, "the same as torque"},
    {"bus_V", Signal::bus_voltage, "the same as bus_voltage"},
    {"bus_A", Signal::bus_current, "the same as bus_current"},
};

inline constexpr auto signal_choices = [] {
  std::array<base::Choice<Signal>, std::size(signal_facts) + std::size(column_words)> all{};
  std::size_t n = 0;
  for (const SignalFact& fact : signal_facts) all[n++] = {fact.word, fact.signal, fact.meaning};
  for (const base::Choice<Signal>& column : column_words) all[n++] = column;
  return all;
}();

constexpr const SignalFact& fact_of(Signal signal) { return signal_facts[static_cast<std::size_t>(signal)]; }

static_assert([] {
  for (std::size_t n = 0; n < std::size(signal_facts); ++n)
    if (static_cast<std::size_t>(signal_facts[n].signal) != n) return false;
  return std::size(signal_facts) == static_cast<std::size_t>(Signal::friction_loss) + 1;
}());

/// Unit of a signal, as shown behind a figure.
constexpr std::string_view unit_of(Signal signal) { return fact_of(signal).unit; }

/// Unit of a figure: its own, or that of the signal it is taken of.
constexpr std::string_view figure_unit(const Measure& m) {
  switch (m.metric) {
    case MetricKind::reach_time:
    case MetricKind::rise_time:
    case MetricKind::settling_time:
      return "s";
    case MetricKind::switching_frequency:
      return "Hz";
    case MetricKind::band_excess:
    case MetricKind::band_deficit:
      return "A";
    case MetricKind::energy:
      return "J";
    case MetricKind::thd:
    case MetricKind::efficiency:
      return "1";
    default:
      return unit_of(m.signal);
  }
}

constexpr bool is_gate(Signal signal) { return signal >= Signal::gate_T1 && signal <= Signal::gate_T6; }
constexpr bool is_power(Signal signal) {
  return signal >= Signal::supply_power && signal <= Signal::friction_loss;
}
/// A product of two of the engine's series (signal_products.hpp).
constexpr bool is_product(Signal signal) {
  return (signal >= Signal::pole_a && signal <= Signal::emf_c) ||
         (is_power(signal) && signal != Signal::load_power);
}
/// Swings about zero at the electrical frequency.
constexpr bool alternates(Signal signal) {
  return (signal >= Signal::phase_a && signal <= Signal::phase_c) ||
         (signal >= Signal::pole_a && signal <= Signal::emf_c);
}
/// Says something of every instant of a period, not only of the controller's samples.
constexpr bool is_known_at_samples(Signal signal) {
  return !is_gate(signal) && !is_power(signal) && signal != Signal::duty &&
         !(signal >= Signal::pole_a && signal <= Signal::line_ca);
}
/// The figures that belong to steps or levels of the reference where no level is given.
constexpr bool is_of_a_step(MetricKind kind) {
  return kind == MetricKind::reach_time || kind == MetricKind::rise_time ||
         kind == MetricKind::settling_time || kind == MetricKind::overshoot;
}
/// Infinite where it never comes.
constexpr bool is_time(MetricKind kind) {
  return kind == MetricKind::reach_time || kind == MetricKind::rise_time || kind == MetricKind::settling_time;
}
constexpr bool is_error(MetricKind kind) {
  return kind == MetricKind::steady_error || kind == MetricKind::largest_error;
}
constexpr bool is_band(MetricKind kind) {
  return kind == MetricKind::band_excess || kind == MetricKind::band_deficit;
}

}  // namespace sixstep::study

// SPDX-License-Identifier: Apache-2.0
// The signals of figures: word, unit and meaning of each, and which figures it allows.
#pragma once
#include <array>
#include <cstdint>
#include <iterator>
#include <string_view>

#include "sixstep/base/describe.hpp"
#include "sixstep/study/scenario/measure.hpp"

namespace sixstep::study {

/// The kind of a signal decides which figures it allows.
enum class SignalKind : std::uint8_t {
  series,         ///< a series of the engine, or a sum of them
  phase_current,  ///< a phase's current, which alternates about zero
  magnitude,      ///< a sum of magnitudes
  voltage,        ///< voltage of a terminal or a line: jumps with the gates
  emf,
  held,  ///< constant between control samples
  duty,  ///< constant between events
  gate,
  power
};

/// One row per signal. `phrase` follows the figure's name: "mean line voltage a to b".
struct SignalFact {
  Signal signal;
  std::string_view word;
  std::string_view phrase;
  std::string_view unit;
  std::string_view meaning;
  SignalKind kind;
};

/// A signal that is also a column of the trace has one word for both. If its column has another word, that
/// word is accepted as well (column_words).
inline constexpr SignalFact signal_facts[] = {
    {Signal::current, "current", "motor current", "A", "motor current (i_p - i_n)/2 of the positive pair, A",
     SignalKind::series},
    {Signal::phase_a, "i_a", "current of phase a", "A", "current into phase a, A", SignalKind::phase_current},
    {Signal::phase_b, "i_b", "current of phase b", "A", "current into phase b, A", SignalKind::phase_current},
    {Signal::phase_c, "i_c", "current of phase c", "A", "current into phase c, A", SignalKind::phase_current},
    {Signal::current_magnitude, "current_magnitude", "half the sum of current magnitudes", "A",
     "half the sum of the phase currents' magnitudes, A", SignalKind::magnitude},
    {Signal::speed, "speed", "speed", "rad/s", "mechanical speed, rad/s", SignalKind::series},
    {Signal::position, "position", "position", "deg", "mechanical angle counted over turns, deg",
     SignalKind::series},
    {Signal::torque, "torque", "torque", "N m", "electromagnetic torque, N m", SignalKind::series},
    {Signal::bus_voltage, "bus_voltage", "bus voltage", "V", "voltage of the bus, V", SignalKind::series},
    {Signal::bus_current, "bus_current", "bus current", "A", "current from the bus into the bridge, A",
     SignalKind::series},
    {Signal::pole_a, "u_a_V", "voltage of terminal a", "V", "voltage of terminal a against the negative rail",
     SignalKind::voltage},
    {Signal::pole_b, "u_b_V", "voltage of terminal b", "V", "voltage of terminal b against the negative rail",
     SignalKind::voltage},
    {Signal::pole_c, "u_c_V", "voltage of terminal c", "V", "voltage of terminal c against the negative rail",
     SignalKind::voltage},
    {Signal::line_ab, "u_ab_V", "line voltage a to b", "V", "line voltage a to b", SignalKind::voltage},
    {Signal::line_bc, "u_bc_V", "line voltage b to c", "V", "line voltage b to c", SignalKind::voltage},
    {Signal::line_ca, "u_ca_V", "line voltage c to a", "V", "line voltage c to a", SignalKind::voltage},
    {Signal::emf_a, "e_a_V", "back-EMF of phase a", "V", "back-EMF of phase a", SignalKind::emf},
    {Signal::emf_b, "e_b_V", "back-EMF of phase b", "V", "back-EMF of phase b", SignalKind::emf},
    {Signal::emf_c, "e_c_V", "back-EMF of phase c", "V", "back-EMF of phase c", SignalKind::emf},
    {Signal::angle, "angle_rad", "angle", "rad", "mechanical angle counted over turns", SignalKind::series},
    {Signal::duty, "duty", "duty", "1",
     "signed duty in effect; with armed comparators the state of the upper switch", SignalKind::duty},
    {Signal::current_reference, "i_ref_A", "current reference", "A", "current reference at the last sample",
     SignalKind::held},
    {Signal::speed_reference, "speed_ref_rad_s", "speed reference", "rad/s",
     "speed reference at the last sample", SignalKind::held},
    {Signal::position_reference, "position_ref_deg", "position reference", "deg", "position setpoint",
     SignalKind::held},
    {Signal::current_error, "current_error_A", "current error", "A", "current reference minus motor current",
     SignalKind::series},
    {Signal::speed_error, "speed_error_rad_s", "speed error", "rad/s", "speed reference minus speed",
     SignalKind::series},
    {Signal::position_error, "position_error_deg", "position error", "deg",
     "position setpoint minus position", SignalKind::series},
    {Signal::load_torque, "load_Nm", "load torque", "N m", "load torque", SignalKind::held},
    {Signal::gate_T1, "gate_T1", "gate T1", "1",
     "upper gate of leg a, 1 while on: the mean of the signal is the duty", SignalKind::gate},
    {Signal::gate_T2, "gate_T2", "gate T2", "1", "lower gate of a", SignalKind::gate},
    {Signal::gate_T3, "gate_T3", "gate T3", "1", "upper gate of b", SignalKind::gate},
    {Signal::gate_T4, "gate_T4", "gate T4", "1", "lower gate of b", SignalKind::gate},
    {Signal::gate_T5, "gate_T5", "gate T5", "1", "upper gate of c", SignalKind::gate},
    {Signal::gate_T6, "gate_T6", "gate T6", "1", "lower gate of c", SignalKind::gate},
    {Signal::supply_power, "supply_power_W", "power from the bus", "W",
     "bus voltage times bus current: power into the bridge", SignalKind::power},
    {Signal::motor_power, "motor_power_W", "power into the motor", "W",
     "electrical power into the motor's terminals", SignalKind::power},
    {Signal::mechanical_power, "mechanical_power_W", "mechanical power", "W",
     "torque times speed: power that the air gap converts", SignalKind::power},
    {Signal::load_power, "load_power_W", "power to the load torque", "W", "load torque times speed",
     SignalKind::power},
    {Signal::copper_loss, "copper_loss_W", "copper loss", "W", "R_s (i_a^2 + i_b^2 + i_c^2)",
     SignalKind::power},
    {Signal::device_loss, "device_loss_W", "device loss", "W", "conduction loss of switches and diodes",
     SignalKind::power},
    {Signal::friction_loss, "friction_loss_W", "friction loss", "W",
     "viscous and dry friction of motor and load together", SignalKind::power},
    {Signal::load_speed, "load_speed_rad_s", "speed of the load", "rad/s",
     "speed behind gear and elastic shaft", SignalKind::series},
    {Signal::load_angle, "load_angle_rad", "angle of the load", "rad",
     "angle behind gear and elastic shaft, over turns", SignalKind::series},
    {Signal::source_current, "source_A", "current of the source", "A",
     "current out of the source into capacitor and bridge", SignalKind::series},
    {Signal::capacitor_current, "capacitor_A", "current of the bus capacitor", "A",
     "current into the bus capacitor: its rms heats the capacitor", SignalKind::series},
    {Signal::battery_charge, "battery_charge", "charge of the battery", "1",
     "charge of the battery, relative to the full charge", SignalKind::series},
    {Signal::battery_recovery, "battery_recovery_V", "recovering voltage of the battery", "V",
     "voltage across battery_recovery_ohm and battery_recovery_F, by which the battery is below its open-circuit voltage, in addition to the drop across resistance_ohm",
     SignalKind::series},
    {Signal::loop_current, "loop_A", "sum of the delta's branch currents", "A",
     "sum of a delta's branch currents, three times the current that circulates; no terminal carries it",
     SignalKind::series},
    {Signal::winding_temperature, "winding_degC", "temperature of the winding", "degC",
     "temperature of the winding, with heat.motor", SignalKind::series},
    {Signal::housing_temperature, "housing_degC", "temperature of the housing", "degC",
     "temperature of housing and magnets, with heat.motor", SignalKind::series},
    {Signal::junction_temperature, "junction_degC", "temperature of the hottest junction", "degC",
     "temperature of the hottest switch's junction, with heat.devices", SignalKind::held},
    {Signal::direct_current, "i_d_A", "current along the magnet", "A",
     "field-oriented: current along the magnet as the drive assumes it, at the last sample",
     SignalKind::held},
    {Signal::quadrature_current, "i_q_A", "current across the magnet", "A",
     "field-oriented: current across the magnet as the drive assumes it, at the last sample",
     SignalKind::held},
    {Signal::direct_current_reference, "i_d_ref_A", "reference of the current along the magnet", "A",
     "field-oriented: reference of the current along the magnet", SignalKind::held},
    {Signal::quadrature_current_reference, "i_q_ref_A", "reference of the current across the magnet", "A",
     "field-oriented: reference of the current across the magnet", SignalKind::held},
    {Signal::direct_voltage, "v_d_V", "voltage along the magnet", "V",
     "field-oriented: commanded phase voltage along the magnet at the last sample", SignalKind::held},
    {Signal::quadrature_voltage, "v_q_V", "voltage across the magnet", "V",
     "field-oriented: commanded phase voltage across the magnet at the last sample", SignalKind::held},
    {Signal::angle_error, "angle_error_deg", "error of the angle", "deg",
     "field-oriented: electrical angle by which the drive's magnet angle was ahead of the true angle, at the last sample",
     SignalKind::held},
};

/// Older words of columns in the trace.
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

/// Words of a linear motor (base/linear.hpp), each with the rotary motor's word.
inline constexpr base::Choice<Signal> linear_signal_words[] = {
    {"force", Signal::torque, "linear motor: electromagnetic force, N", "torque"},
    {"force_N", Signal::torque, "linear motor: the same as force", "torque_Nm"},
    {"speed_m_s", Signal::speed, "linear motor: the same as speed, m/s", "speed_rad_s"},
    {"position_m", Signal::angle, "linear motor: the same as position, in m", "angle_rad"},
    {"speed_ref_m_s", Signal::speed_reference, "linear motor: speed reference at the last sample",
     "speed_ref_rad_s"},
    {"position_ref_mm", Signal::position_reference, "linear motor: position setpoint", "position_ref_deg"},
    {"speed_error_m_s", Signal::speed_error, "linear motor: speed reference minus speed",
     "speed_error_rad_s"},
    {"position_error_mm", Signal::position_error, "linear motor: position setpoint minus position",
     "position_error_deg"},
    {"load_N", Signal::load_torque, "linear motor: load force", "load_Nm"},
    {"load_speed_m_s", Signal::load_speed, "linear motor: speed behind an elastic coupling",
     "load_speed_rad_s"},
    {"load_position_m", Signal::load_angle, "linear motor: position behind an elastic coupling",
     "load_angle_rad"},
};

inline constexpr auto signal_choices = [] {
  std::array<base::Choice<Signal>,
             std::size(signal_facts) + std::size(column_words) + std::size(linear_signal_words)>
      all{};
  std::size_t n = 0;
  for (const SignalFact& fact : signal_facts) all[n++] = {fact.word, fact.signal, fact.meaning};
  for (const base::Choice<Signal>& column : column_words) all[n++] = column;
  for (const base::Choice<Signal>& word : linear_signal_words) all[n++] = word;
  return all;
}();

constexpr const SignalFact& fact_of(Signal signal) { return signal_facts[static_cast<std::size_t>(signal)]; }

static_assert([] {
  for (std::size_t n = 0; n < std::size(signal_facts); ++n)
    if (static_cast<std::size_t>(signal_facts[n].signal) != n) return false;
  return std::size(signal_facts) == static_cast<std::size_t>(Signal::angle_error) + 1;
}());

/// Unit of a signal, as shown behind a figure.
constexpr std::string_view unit_of(Signal signal) { return fact_of(signal).unit; }

/// True if only a field-oriented drive has the signal.
constexpr bool is_of_field(Signal signal) { return signal >= Signal::direct_current; }
constexpr bool is_gate(Signal signal) { return fact_of(signal).kind == SignalKind::gate; }
constexpr bool is_power(Signal signal) { return fact_of(signal).kind == SignalKind::power; }
/// True if the signal is a product of two of the engine's series (signal_products.hpp).
constexpr bool is_product(Signal signal) {
  const SignalKind kind = fact_of(signal).kind;
  return kind == SignalKind::voltage || kind == SignalKind::emf || kind == SignalKind::power;
}
/// True if the signal alternates about zero at the electrical frequency.
constexpr bool alternates(Signal signal) {
  const SignalKind kind = fact_of(signal).kind;
  return kind == SignalKind::phase_current || kind == SignalKind::voltage || kind == SignalKind::emf;
}
/// True if the controller's samples represent the signal. False for signals that jump at the sample instants.
constexpr bool is_known_at_samples(Signal signal) {
  const SignalKind kind = fact_of(signal).kind;
  return !is_power(signal) && kind != SignalKind::gate && kind != SignalKind::duty &&
         kind != SignalKind::voltage;
}

}  // namespace sixstep::study

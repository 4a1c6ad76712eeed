// SPDX-License-Identifier: Apache-2.0
// Monitors the measurements for faults: latches each fault with its reason, and clears it only on request once
// the cause is gone. It reacts within the tick; a faster reaction is left to the board's comparator.
#pragma once
#include <cstdint>

#include "sixstep/control/bridge_command.hpp"
#include "sixstep/control/fixed.hpp"
#include "sixstep/control/scalar.hpp"

namespace sixstep::control {

/// Bits of a set of faults.
enum Fault : std::uint16_t {
  fault_none = 0,
  fault_over_current = 1,
  fault_over_voltage = 2,
  fault_under_voltage = 4,
  fault_over_speed = 8,
  fault_hall = 16,         ///< an impossible code, a jump, or an edge that makes the speed impossible
  fault_stall = 32,        ///< current without movement for too long
  fault_calibration = 64,  ///< the offset of a current amplifier is out of tolerance
  fault_align = 128        ///< the rotor did not reach the sector to which it was pulled
};

/// The defaults trip at any bus voltage or current, so that no limit can be forgotten.
template <class Scalar>
struct FaultConfig {
  Scalar over_current_A{};         ///< trips if |i| of a phase is above it
  Scalar over_voltage_V{};         ///< trips if the bus is above it
  Scalar under_voltage_V{};        ///< trips if the bus is below it
  Scalar over_speed_rad_s{};       ///< trips if |w| is above it
  Scalar stall_current_A{};        ///< |i| of a phase above it without a Hall edge is a stall
  std::uint32_t stall_ticks = 0;   ///< ticks in a row after which a stall trips
  std::uint8_t voltage_ticks = 1;  ///< ticks in a row after which a wrong voltage trips; 0 counts as 1
  bool operator==(const FaultConfig&) const = default;
};

struct FaultState {
  std::uint16_t present = 0;  ///< causes seen in the last tick
  std::uint16_t latched = 0;  ///< all causes since the last clearing
  std::uint16_t first = 0;    ///< causes in the tick that stopped the drive
  std::uint32_t still = 0;    ///< ticks with stall current and no edge
  std::uint8_t over = 0, under = 0;
  std::uint8_t hall_line = 0;  ///< 1..3: the faulty Hall line; 0: unknown
};

struct FaultEvents {
  bool hall = false;            ///< impossible code or jump, now
  std::uint8_t hall_line = 0;   ///< 1..3: the line of that fault; 0: unknown
  bool moved = false;           ///< a Hall edge since the last tick
  std::uint8_t false_edge = 0;  ///< 1..3: line with an edge that a steady rotor cannot make; 0: none
  std::uint16_t other = 0;      ///< other faults: calibration, alignment
};

/// Returns the latched set; unless it is 0 the bridge must be turned off. A comparison with a value that is not
/// a number fails, and each comparison is written so that failing trips.
template <class Scalar>
constexpr std::uint16_t fault_step(const FaultConfig<Scalar>& config, FaultState& state,
                                   const Measurement<Scalar>& m, const FaultEvents& events) {
  const auto within = [](Scalar x, Scalar limit) { return x <= limit && x >= -limit; };
  const auto all_within = [&](Scalar limit) {
    return within(m.i_a_A, limit) && within(m.i_b_A, limit) && within(m.i_c_A, limit);
  };
  const auto lasting = [&](bool wrong, std::uint8_t& ticks) {
    ticks = !wrong ? std::uint8_t{0} : ticks < 255 ? static_cast<std::uint8_t>(ticks + 1) : ticks;
    return wrong && ticks >= config.voltage_ticks;
  };
  const bool still = !events.moved && !all_within(config.stall_current_A);
  state.still = !still ? 0u : state.still < 0xffffffffu ? state.still + 1 : state.still;
  unsigned now = events.other;
  if (!all_within(config.over_current_A)) now |= fault_over_current;
  if (lasting(!(m.bus_V <= config.over_voltage_V), state.over)) now |= fault_over_voltage;
  if (lasting(!(m.bus_V >= config.under_voltage_V), state.under)) now |= fault_under_voltage;
  const bool too_fast = !within(m.speed_rad_s, config.over_speed_rad_s);
  // A false edge and a real overspeed give the same measurement, so both faults are reported; the line is reported
  // only if a code proves it.
  if (too_fast) now |= fault_over_speed;
  if (too_fast && events.false_edge != 0) now |= fault_hall;
  if (events.hall) now |= fault_hall;
  if (still && state.still >= config.stall_ticks) now |= fault_stall;
  state.present = static_cast<std::uint16_t>(now);
  if (state.latched == 0) state.first = state.present;
  if (state.hall_line == 0) state.hall_line = events.hall_line;
  state.latched = static_cast<std::uint16_t>(state.latched | now);
  return state.latched;
}

/// Clears the latched faults, but only while no cause is present. True if they are cleared.
constexpr bool fault_clear(FaultState& state) {
  if (state.present != 0) return false;
  state = FaultState{};
  return true;
}

}  // namespace sixstep::control

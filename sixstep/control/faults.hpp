// SPDX-License-Identifier: Apache-2.0
// Monitors the measurements for faults. A fault is latched with its reason. It is cleared only on request,
// after its cause has ended. The monitor reacts within the tick; only the board's comparator reacts faster.
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
  fault_hall = 16,         ///< an invalid code, a jump over a sector, or an edge that implies an impossible
                           ///< speed
  fault_stall = 32,        ///< current without movement for too long
  fault_calibration = 64,  ///< the offset of a current amplifier is out of tolerance
  fault_align = 128        ///< the rotor did not reach the sector of the alignment
};

/// Default: any bus voltage and any current is a fault. A forgotten limit is therefore reported at once.
template <class Scalar>
struct FaultConfig {
  Scalar over_current_A{};    ///< a phase current with |i| above this value is a fault
  Scalar over_voltage_V{};    ///< a bus voltage above this value is a fault
  Scalar under_voltage_V{};   ///< a bus voltage below this value is a fault
  Scalar over_speed_rad_s{};  ///< a speed with |w| above this value is a fault
  Scalar stall_current_A{};   ///< a phase current with |i| above this value, without a Hall edge, is a stall
  std::uint32_t stall_ticks = 0;   ///< consecutive ticks after which a stall is a fault
  std::uint8_t voltage_ticks = 1;  ///< consecutive ticks after which a wrong voltage is a fault; 0 counts as
                                   ///< 1
  bool operator==(const FaultConfig&) const = default;
};

struct FaultState {
  std::uint16_t present = 0;  ///< causes that were present in the last tick
  std::uint16_t latched = 0;  ///< all causes since the last clearing
  std::uint16_t first = 0;    ///< causes in the tick that stopped the drive
  std::uint32_t still = 0;    ///< consecutive ticks with stall current and without an edge
  std::uint8_t over = 0, under = 0;
  std::uint8_t hall_line = 0;  ///< 1..3: the faulty Hall line; 0: unknown
};

struct FaultEvents {
  bool hall = false;            ///< true: an invalid code or a jump over a sector in this tick
  std::uint8_t hall_line = 0;   ///< 1..3: the faulty line; 0: unknown
  bool moved = false;           ///< true: a Hall edge occurred since the last tick
  std::uint8_t false_edge = 0;  ///< 1..3: line with an edge that is impossible at steady speed; 0: none
  std::uint16_t other = 0;      ///< other causes: calibration, alignment
};

/// Checks one tick's measurement and returns the latched set. Turn the bridge off unless the set is 0. Each
/// comparison is written so that `false` means a fault, because a comparison with NaN is false.
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
  // A false edge and a real overspeed cause the same measurement; therefore both faults are set. The faulty
  // line is reported only if an invalid code identifies it.
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

/// Clears the latched faults if no cause is present. Returns true if they are cleared.
constexpr bool fault_clear(FaultState& state) {
  if (state.present != 0) return false;
  state = FaultState{};
  return true;
}

}  // namespace sixstep::control

// SPDX-License-Identifier: Apache-2.0
// Measures the magnet's flux linkage while the rotor follows a turning voltage vector without load. The
// computation is in the vector's frame. In this frame, means over whole electrical turns contain the
// fundamental only:
//
//   e = v - R i - j w L i - (3/4) lost s,    psi = |e|/w
//
// v: voltage vector, i: current, e: back-EMF, w: electrical speed, R and L of a phase. `lost` is the voltage
// that dead time and diodes subtract from a vector along a phase (level_steps.hpp), 4/3 of the loss of one
// leg. s is the vector of the signs of the legs' currents, and j w L i is the voltage of the inductance. The
// rotor's lag behind the vector has no influence. A relative error of R changes psi by R i/e times this
// error. R i/e is below 2 at e = v/2.
#pragma once
#include <cstdint>

#include "sixstep/control/commissioning/level_steps.hpp"

namespace sixstep::control {

/// Currents at one tick, and their signs, in the vector's frame.
struct FieldCurrent {
  FieldVector current{}, signs{};
};

/// Sums over the ticks of whole electrical turns.
struct FluxTurnState {
  std::int64_t along = 0, across = 0;              ///< currents, 24ths of a count
  std::int64_t signs_along = 0, signs_across = 0;  ///< sums of the signs of the legs' currents; a sign counts
                                                   ///< 24
  std::int64_t bus = 0;                            ///< bus voltage, counts
  std::uint32_t ticks = 0;
};

/// Voltages in 2^-8 bus counts; the flux in 2^-4 bus counts, times ticks in a turn.
struct FluxTurnReading {
  std::int32_t applied = 0;  ///< v, length of the voltage vector
  std::int32_t emf = 0;      ///< |e|, length of the back-EMF vector
  std::int32_t flux = 0;     ///< |e| divided by the speed in turns per tick
};

constexpr void flux_turn_tick(FluxTurnState& state, const FieldCurrent& seen, std::uint16_t bus_counts) {
  state.along += seen.current.along;
  state.across += seen.current.across;
  state.signs_along += seen.signs.along;
  state.signs_across += seen.signs.across;
  state.bus += bus_counts;
  ++state.ticks;
}

/// w L in the unit of `winding.resistance`; `speed` in 2^-32 turns per tick.
constexpr std::int64_t reactance_of(const LevelStepsReading& winding, std::uint32_t speed) {
  constexpr std::int64_t two_pi_16 = 411775;
  const std::int64_t turns_32 = detail::shifted_down(static_cast<std::int64_t>(winding.tau) * speed, 16);
  return detail::shifted_down(detail::shifted_down(turns_32 * two_pi_16, 16) * winding.resistance, 32);
}

/// Result for a vector of length v, in units of 2^-20 of the bus.
constexpr FluxTurnReading flux_turn_reading(const LevelStepsReading& winding, const FluxTurnState& state,
                                            std::int32_t v, std::uint32_t speed) {
  FluxTurnReading reading{};
  if (state.ticks == 0 || speed == 0) return reading;
  const std::int64_t R = winding.resistance, X = reactance_of(winding, speed);
  const std::int64_t applied = detail::ratio_of(v * state.bus, std::int64_t{4096} * state.ticks);
  const std::int64_t d = detail::ratio_of(state.along * 256, std::int64_t{24} * state.ticks);
  const std::int64_t q = detail::ratio_of(state.across * 256, std::int64_t{24} * state.ticks);
  const std::int64_t of_legs = std::int64_t{4} * 8 * state.ticks;  // 24 per leg, divided by 3/4
  const std::int64_t lost_d = detail::ratio_of(winding.lost * state.signs_along, of_legs);
  const std::int64_t lost_q = detail::ratio_of(winding.lost * state.signs_across, of_legs);
  const std::int64_t along = applied - detail::shifted_down(R * d - X * q, 20) - lost_d;
  const std::int64_t across = -detail::shifted_down(R * q + X * d, 20) - lost_q;
  reading.applied = detail::held_to_32(applied);
  reading.emf = static_cast<std::int32_t>(length_of(detail::held_to_32(along), detail::held_to_32(across)));
  reading.flux = detail::held_to_32(
      detail::ratio_of(static_cast<std::int64_t>(reading.emf) << 28, static_cast<std::int64_t>(speed)));
  return reading;
}

}  // namespace sixstep::control

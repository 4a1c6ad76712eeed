// SPDX-License-Identifier: Apache-2.0
// The commutation table: only this file relates Hall codes, sectors and driven pairs (model.md 3).
#pragma once
#include <cstdint>

#include "sixstep/control/bridge_command.hpp"
#include "sixstep/control/fixed.hpp"
#include "sixstep/control/scalar.hpp"

namespace sixstep::control {

inline constexpr std::uint8_t no_sector = 0xff;

/// Sector 0..5 (60 electrical degrees each) of a Hall code H1 H2 H3 (bits 2, 1, 0). Returns no_sector for 000
/// and 111: intact probes 120 degrees apart never produce these codes, so a wire or a probe is broken.
constexpr std::uint8_t sector_of_hall(std::uint8_t code) {
  switch (code) {
    case 0b100:
      return 0;
    case 0b110:
      return 1;
    case 0b010:
      return 2;
    case 0b011:
      return 3;
    case 0b001:
      return 4;
    case 0b101:
      return 5;
    default:
      return no_sector;
  }
}

/// The code of a sector, from probes 120 degrees apart; 000 for a number that is no sector.
constexpr std::uint8_t hall_of_sector(std::uint8_t sector) {
  constexpr std::uint8_t codes[6] = {0b100, 0b110, 0b010, 0b011, 0b001, 0b101};
  return sector < 6 ? codes[sector] : std::uint8_t{0};
}

/// The pair with positive torque in sectors 0 to 5: T1 T4, T1 T6, T3 T6, T3 T2, T5 T2, T5 T4.
constexpr Pair positive_pair(std::uint8_t sector) {
  switch (sector) {
    case 0:
      return {Leg::a, Leg::b};
    case 1:
      return {Leg::a, Leg::c};
    case 2:
      return {Leg::b, Leg::c};
    case 3:
      return {Leg::b, Leg::a};
    case 4:
      return {Leg::c, Leg::a};
    default:
      return {Leg::c, Leg::b};
  }
}

constexpr Pair swapped(Pair pair) { return {pair.sink, pair.source}; }

template <class Scalar>
constexpr Scalar phase_current(const Measurement<Scalar>& m, Leg leg) {
  return leg == Leg::a ? m.i_a_A : leg == Leg::b ? m.i_b_A : m.i_c_A;
}

/// Motor current i_m = (i_p - i_n)/2, with the currents i_p of the source and i_n of the sink of the
/// positive-torque pair. On flat tops the torque T_e is K_t i_m, with the torque constant K_t (model.md 3).
template <class Scalar>
constexpr Scalar motor_current(const Measurement<Scalar>& m, Pair positive) {
  return ScalarTraits<Scalar>::half_difference(phase_current(m, positive.source),
                                               phase_current(m, positive.sink));
}

/// The staying phase: it conducts before and after a commutation.
struct StayingPhase {
  std::uint8_t sector = no_sector;  ///< sector of the last sample
  Leg leg = Leg::a;
};

/// The leg of the staying phase. Returns the source of the positive pair if there was no pair before, or if
/// the pairs before and after have no leg in common.
constexpr Leg staying_leg(StayingPhase& state, std::uint8_t sector) {
  if (sector == state.sector) return state.leg;
  const Pair now = positive_pair(sector),
             before = state.sector == no_sector ? now : positive_pair(state.sector);
  state.leg = now.sink == before.sink && now.source != before.source ? now.sink : now.source;
  state.sector = sector;
  return state.leg;
}

/// i_m measured in the staying phase only. During a commutation this current i determines the torque T_e: T_e
/// w = 2 E i while all back-EMFs are flat, with speed w and back-EMF E of a phase. At other times it equals
/// the current of the pair.
template <class Scalar>
constexpr Scalar staying_current(StayingPhase& state, const Measurement<Scalar>& m, std::uint8_t sector) {
  const Leg leg = staying_leg(state, sector);
  const Scalar i = phase_current(m, leg);
  return leg == positive_pair(sector).source ? i : -i;
}

}  // namespace sixstep::control

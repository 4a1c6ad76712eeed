// SPDX-License-Identifier: Apache-2.0
// Computes the magnet's flux linkage psi with the free phase. The drive commutates when psi has fallen by a
// fixed amount psi_c:
//
//   psi = integral(w - R i) dt - L i          w: floating_voltage.hpp, without a star point
//   discretised exactly:   psi[n+1] - psi[n] = T g,   g = w - (i[n+1] - a i[n])/b,
//                          a = exp(-R T/L),   b = (1 - a)/R
//
// In the sector in which the phase's leg floats, psi grows up to the zero crossing and falls after it. From
// the crossing to the commutation 30 degrees later psi falls by
//
//   psi_c = K_e/p integral_0^(pi/6) (2 s_f - s_s - s_k)/3 dtheta      s: shapes of the three back-EMFs
//
// at every speed and acceleration. Nothing is extrapolated from earlier sectors, and K_e is the only data of
// the motor in psi_c. The fall of psi grows with the square of the angle: an error of 10 % in K_e shifts the
// commutation by 1.5 degrees. In each sector the fall is counted from the maximum of psi, so that a drift
// does not accumulate over sectors. The integral averages the noise of the terminals. R and L have an effect
// only while the leg's old current decays, before psi falls.
//
// Texas Instruments' InstaSPIN-BLDC uses this law with a threshold that the user adjusts on the bench.
#pragma once
#include <cstdint>

#include "sixstep/control/fixed.hpp"
#include "sixstep/control/scalar.hpp"

namespace sixstep::control {

/// Default: psi is always 0. psi is stored as a multiple of 4 psi_c, so that the level is 1/4 for every
/// motor.
template <class Scalar>
struct FluxLinkageConfig {
  Gain<Scalar> decay{};      ///< a, decay of the current over a period
  Gain<Scalar> stiffness{};  ///< 1/b, voltage per ampere of change in a period
  Gain<Scalar> per_V{};      ///< T/(4 psi_c): psi per V and period
  Scalar level{};            ///< fall of psi at which the drive commutates
  bool operator==(const FluxLinkageConfig&) const = default;
};

/// The signs are chosen so that the back-EMF g falls through zero in every sector.
template <class Scalar>
struct FluxLinkageState {
  Scalar i_A{};                      ///< current at the last sample
  Scalar g_V{};                      ///< mean back-EMF of the last period
  Accumulator<Scalar> psi{}, top{};  ///< psi and its maximum since the sector began
  Scalar per_tick{};                 ///< fall of psi in the last period
  Scalar steeper{};                  ///< increase of per_tick since the previous period
  std::uint16_t falling = 0;         ///< periods since the maximum of psi
};

/// Advances by a period with the mean voltage w_V, and the current i_A at the period's end. Returns the mean
/// of g, V.
template <class Scalar>
constexpr Scalar flux_linkage_step(const FluxLinkageConfig<Scalar>& config, FluxLinkageState<Scalar>& state,
                                   Scalar w_V, Scalar i_A) {
  using T = ScalarTraits<Scalar>;
  const Scalar jump = i_A - T::product(state.i_A, config.decay);
  state.i_A = i_A;
  state.g_V = w_V - T::product(jump, config.stiffness);
  const Scalar before = state.per_tick;
  state.per_tick = -T::product(state.g_V, config.per_V);
  state.steeper = state.per_tick - before;
  state.psi = state.psi + T::accumulated(state.g_V, config.per_V);
  if (state.falling < 0xffff) ++state.falling;
  if (state.psi > state.top) {
    state.top = state.psi;
    state.falling = 0;
  }
  return state.g_V;
}

/// Begins a sector, in which the next leg floats. The signs are again chosen so that g falls: the new g is
/// minus the last g.
template <class Scalar>
constexpr void flux_linkage_begin(FluxLinkageState<Scalar>& state) {
  const Scalar g_V = -state.g_V;
  state = {};
  state.g_V = g_V;
}

/// Advances by a period of unknown voltage. After the crossing psi continues to fall, as with a back-EMF that
/// is proportional to the time since the crossing.
template <class Scalar>
constexpr Scalar flux_linkage_hold(FluxLinkageState<Scalar>& state, Scalar i_A) {
  using T = ScalarTraits<Scalar>;
  state.i_A = i_A;
  if (state.falling == 0) return state.g_V;
  // The middle of the last period was `falling` - 1/2 periods after the crossing.
  state.steeper = state.per_tick * T::fraction(2, 2 * std::uint32_t{state.falling} - 1);
  state.per_tick = state.per_tick + state.steeper;
  state.psi = state.psi - T::accumulator(state.per_tick);
  if (state.falling < 0xffff) ++state.falling;
  return state.g_V;
}

/// True if the fall of psi reaches the level within the next period. `part`: fraction of the period after
/// which it does.
template <class Scalar>
constexpr bool flux_level_comes(const FluxLinkageConfig<Scalar>& config,
                                const FluxLinkageState<Scalar>& state, Scalar& part) {
  using T = ScalarTraits<Scalar>;
  const Scalar rest = config.level - T::signal(state.top - state.psi);
  const Scalar next = state.per_tick + state.steeper;
  part = Scalar{};
  if (!(rest > Scalar{})) return true;
  if (!(next > Scalar{}) || next < rest) return false;
  part = rest / next;
  return true;
}

}  // namespace sixstep::control

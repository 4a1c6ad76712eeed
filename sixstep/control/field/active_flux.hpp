// SPDX-License-Identifier: Apache-2.0
// Finds the direction of a turning magnet from its flux in the winding (Boldea, Paicu and Andreescu, Active
// Flux Concept for Motion-Sensorless Unified AC Drives, IEEE Trans. PE 23, 2008). In the stator's frame, for
// any saliency:
//
//   lambda = integral(u - R i) dt        the winding's total flux
//   psi_a  = lambda - L_q i              active flux: along the magnet, of length psi + (L_d - L_q) i_d
//
// u and i are voltage and current, psi is the magnet's flux linkage. An integral keeps its initial error
// forever. In each control period T, lambda therefore moves towards the flux of a magnet in the assumed
// direction theta^, by a fraction g of the difference:
//
//   lambda[n] = lambda[n-1] + T (u - R (i[n] + i[n-1])/2) + g (L_q i + psi_a(theta^) - lambda)
//
// In the rotor's frame an error of the flux rotates backwards with the electrical speed w_e. If the rotor
// turns, the error decays with the polynomial s^2 + w_g s + w_e^2, g = 1 - exp(-w_g T). At standstill it does
// not decay. u is the mean commanded voltage from the last sample to this sample.
#pragma once
#include "sixstep/control/frames.hpp"
#include "sixstep/control/scalar.hpp"

namespace sixstep::control {

/// Default: the result is 0.
template <class Scalar>
struct ActiveFluxConfig {
  Gain<Scalar> period_s{};        ///< T, control period
  Gain<Scalar> R_ohm{};           ///< resistance of a phase
  Gain<Scalar> L_q_H{}, L_D_H{};  ///< phase inductance L_q, and L_D = L_d - L_q
  Scalar magnet_Vs{};             ///< psi, the magnet's flux linkage, V s; 0: none
  Gain<Scalar> pull{};            ///< g, fraction of the error that a period corrects
  bool operator==(const ActiveFluxConfig&) const = default;
};

template <class Scalar>
struct ActiveFluxState {
  AlphaBeta<Scalar> flux{};     ///< lambda, V s
  AlphaBeta<Scalar> current{};  ///< current at the last sample, A
  Scalar along{}, across{};     ///< psi_a at the last sample along and across the given direction, V s
};

/// One sample; `magnet` is the assumed direction. Returns the angle by which the magnet is ahead of the
/// assumed direction: approximately in rad, limited to -1..1.
template <class Scalar>
constexpr Scalar active_flux_step(const ActiveFluxConfig<Scalar>& config, ActiveFluxState<Scalar>& state,
                                  const AlphaBeta<Scalar>& mean_V, const AlphaBeta<Scalar>& i,
                                  const Direction<Scalar>& magnet) {
  const Scalar half_R = config.R_ohm * static_cast<Scalar>(0.5);
  state.flux.alpha += config.period_s * (mean_V.alpha - half_R * (i.alpha + state.current.alpha));
  state.flux.beta += config.period_s * (mean_V.beta - half_R * (i.beta + state.current.beta));
  state.current = i;
  const Scalar expected = config.magnet_Vs + config.L_D_H * (i.alpha * magnet.cos + i.beta * magnet.sin);
  const AlphaBeta<Scalar> active{state.flux.alpha - config.L_q_H * i.alpha,
                                 state.flux.beta - config.L_q_H * i.beta};
  state.flux.alpha += config.pull * (expected * magnet.cos - active.alpha);
  state.flux.beta += config.pull * (expected * magnet.sin - active.beta);
  const Dq<Scalar> seen = park(active, magnet);
  state.along = seen.d;
  state.across = seen.q;
  const Scalar size = magnitude(seen.d) + magnitude(seen.q);
  if (!(size > Scalar{})) return Scalar{};
  // Approximately the sine of the angle. Beyond 90 degrees: 1 or -1, the sign of the shorter rotation.
  const Scalar part = seen.q / size;
  return seen.d < Scalar{} ? (seen.q < Scalar{} ? -one<Scalar> : one<Scalar>) : part;
}

}  // namespace sixstep::control

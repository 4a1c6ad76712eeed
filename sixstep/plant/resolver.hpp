// SPDX-License-Identifier: Apache-2.0
// Output voltages of a resolver with p_r pole pairs (model.md 10), for the shaft's angle theta, the
// excitation's angular frequency w_x and the time t. The rig adds noise to both voltages:
//
//   V_1 = k V_R sin(w_x t + d_1) cos(p_r theta)
//   V_2 = k (1 + a) V_R sin(w_x t + d_2) sin(p_r theta + q)
#pragma once
#include <array>

#include "sixstep/base/elementary.hpp"
#include "sixstep/plant/encoder.hpp"

namespace sixstep::plant {

struct Resolver {
  double amplitude_V = 1.0;  ///< k V_R, peak of the cosine winding
  double excitation_Hz = 10e3;
  int pole_pairs = 1;                           ///< p_r, pole pairs of the resolver
  double imbalance = 0.0;                       ///< a, excess of the sine winding's amplitude, relative
  double quadrature_rad = 0.0;                  ///< q, deviation of the windings from a right angle
  double phase_1_rad = 0.0, phase_2_rad = 0.0;  ///< d_1, d_2: phase of windings and cable
};

namespace detail {

/// p_r theta, rad, without the whole turns of the shaft.
template <class Real>
double resolver_angle_rad(const Resolver& r, const ShaftAngle<Real>& at) {
  const std::int64_t per_turn = 6 * at.pole_pairs;
  const std::int64_t rest = ((at.sector % per_turn) + per_turn) % per_turn;
  const double turns = (static_cast<double>(rest) + static_cast<double>(at.x) / base::sector_rad) /
                       static_cast<double>(per_turn) * r.pole_pairs;
  return 2 * base::pi * (turns - std::floor(turns));
}

}  // namespace detail

/// Faults of a resolver during a run.
struct ResolverFaults {
  std::uint8_t broken = 0;  ///< bit 0: the cosine winding has no signal; bit 1: the sine winding has no
                            ///< signal
  double excitation = 1.0;  ///< amplitude of the excitation, relative to the intact excitation

  /// Signals of both windings with the faults, from the signals `whole` without faults and `noise`, all in
  /// the same unit. The noise does not depend on the excitation. A broken winding has no noise.
  std::array<double, 2> leave(const std::array<double, 2>& whole, const std::array<double, 2>& noise) const {
    return {(broken & 1) != 0 ? 0.0 : excitation * whole[0] + noise[0],
            (broken & 2) != 0 ? 0.0 : excitation * whole[1] + noise[1]};
  }
};

/// Signals of both windings after an ideal demodulator, relative to the cosine's amplitude: cos(p_r theta)
/// and (1 + a) sin(p_r theta + q).
template <class Real>
std::array<double, 2> resolver_envelope(const Resolver& r, const ShaftAngle<Real>& at) {
  const double angle = detail::resolver_angle_rad(r, at);
  return {base::cos(angle), (1 + r.imbalance) * base::sin(angle + r.quadrature_rad)};
}

/// V_1 and V_2, V, without noise. Whole cycles of the excitation are removed before the sine is computed, for
/// accuracy at a large t.
template <class Real>
std::array<double, 2> resolver_V(const Resolver& r, const ShaftAngle<Real>& at, std::int64_t t_ps) {
  const double angle = detail::resolver_angle_rad(r, at);
  const double cycles = r.excitation_Hz * (static_cast<double>(t_ps) * 1e-12);
  const double carrier = 2 * base::pi * (cycles - std::floor(cycles));
  return {r.amplitude_V * base::sin(carrier + r.phase_1_rad) * base::cos(angle),
          r.amplitude_V * (1 + r.imbalance) * base::sin(carrier + r.phase_2_rad) *
              base::sin(angle + r.quadrature_rad)};
}

}  // namespace sixstep::plant

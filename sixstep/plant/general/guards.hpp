// SPDX-License-Identifier: Apache-2.0
// What must stay >= 0 while a mode of the general plant holds, by the same series as its dynamics (plant/guards.hpp). A leg
// that floats stays between the voltages at which it would begin to conduct either way: for a leg without a gate those of its
// diodes, for an IGBT with one that of its transistor too (model.md 2).
#pragma once
#include "sixstep/plant/general/expand.hpp"
#include "sixstep/plant/guards.hpp"

namespace sixstep::plant::general {

/// What a leg without current may become, by its gates: the connection that carries a positive current and the one that
/// carries a negative one.
struct Ways {
  Connection positive = Connection::low_diode, negative = Connection::high_diode;
};
inline Ways ways_of(const Devices& devices, bool gate_high, bool gate_low) {
  if (devices.igbt && gate_high) return {Connection::high_switch, Connection::high_diode};
  if (devices.igbt && gate_low) return {Connection::low_diode, Connection::low_switch};
  return {};
}

/// Whether a connection carries one direction only, and which: 1, -1; 0 for a MOSFET's channel.
inline int direction_of(const Devices& devices, Connection c) {
  if (c == Connection::low_diode) return 1;
  if (c == Connection::high_diode) return -1;
  if (!devices.igbt || is_floating(c)) return 0;
  return c == Connection::high_switch ? 1 : -1;
}

namespace detail {

/// sign (pole voltage of `at` without current - u) as a series.
template <class Real>
series::Coefficients<Real> beyond(const PoleTerms<Real>& at, const Expansion<Real>& y,
                                  const series::Coefficients<Real>& u, Real sign) {
  series::Coefficients<Real> g;
  for (int n = 0; n <= y.degree; ++n) g[n] = sign * (at.bus_share * y.bus[n] - u[n]);
  g[0] += sign * at.offset_V;
  return g;
}

template <class Real, class Visit>
void leg_guards(const Constants<Real>& c, const Gates& gates, const Mode& mode, unsigned dead,
                const Expansion<Real>& y, const Series<Real>& z, Real slack, Visit&& visit) {
  const Real noise = c.volt_noise * slack;
  const int connected = connected_count(mode.legs);
  const auto terms = [&](Connection at) -> const PoleTerms<Real>& {
    return c.poles[static_cast<std::size_t>(at)];
  };
  PerLeg<Ways> ways;
  for (unsigned k = 0; k < 3; ++k) ways[k] = ways_of(c.devices, gates.high[k], gates.low[k]);
  if (connected == 0) {
    for (unsigned j = 0; j < 3; ++j)
      for (unsigned k = 0; k < 3; ++k) {
        if (j == k || (dead >> j & 1) != 0 || (dead >> k & 1) != 0) continue;
        // e_j - e_k at most what j's negative way stands above k's positive one.
        series::Coefficients<Real> g = beyond(terms(ways[j].negative), y, z.pole[j], Real(1));
        const series::Coefficients<Real> low = beyond(terms(ways[k].positive), y, z.pole[k], Real(-1));
        for (int n = 0; n <= y.degree; ++n) g[n] += low[n];
        visit(guard::free_star + 3 * static_cast<int>(j) + static_cast<int>(k), g, y.degree, noise);
      }
    return;
  }
  for (unsigned k = 0; k < 3; ++k) {
    if (!is_floating(mode.legs[k]) || (dead >> k & 1) != 0) continue;
    const int id = static_cast<int>(k);
    visit(guard::low_rail + id, beyond(terms(ways[k].positive), y, z.pole[k], Real(-1)), y.degree, noise);
    visit(guard::high_rail + id, beyond(terms(ways[k].negative), y, z.pole[k], Real(1)), y.degree, noise);
  }
}

template <class Real, class Visit>
void shaft_guards(const Constants<Real>& c, const Mode& mode, const Expansion<Real>& y, const Series<Real>& z,
                  Real slack, Visit&& visit) {
  if (c.dry_friction) {
    const Real speed_noise = c.speed_noise * plant::detail::doubt(y.w, slack);
    if (mode.motion == Motion::forward) visit(guard::standstill, y.w, y.degree, speed_noise);
    if (mode.motion == Motion::backward)
      visit(guard::standstill, plant::detail::affine(y.w, y.degree, Real(-1), Real(0)), y.degree,
            speed_noise);
    if (mode.motion == Motion::stuck) {
      const Real noise = c.torque_noise * slack;
      visit(guard::breakaway_forward, plant::detail::affine(z.shaft, y.degree, Real(-1), c.breakaway),
            y.degree, noise);
      visit(guard::breakaway_backward, plant::detail::affine(z.shaft, y.degree, Real(1), c.breakaway),
            y.degree, noise);
    }
  }
  if (c.fan != 0)
    visit(guard::load_turns, plant::detail::affine(z.load_w, y.degree, Real(mode.load_sign), Real(0)),
          y.degree, c.speed_noise * c.inv_gear * plant::detail::doubt(z.load_w, slack));
}

template <class Real, class Visit>
void supply_guards(const Constants<Real>& c, const Mode& mode, const Expansion<Real>& y,
                   const Series<Real>& z, Real slack, Visit&& visit) {
  if (!c.source_sinks) {
    if (mode.source_feeds && c.inv_L_b > 0)
      visit(guard::source, z.source, y.degree, c.amp_noise * plant::detail::doubt(z.source, slack));
    else
      visit(guard::source,
            mode.source_feeds ? plant::detail::affine(y.bus, y.degree, Real(-1), c.V_0)
                              : plant::detail::affine(y.bus, y.degree, Real(1), -c.V_0),
            y.degree, c.volt_noise * slack);
  }
  if (c.brake_conductance > 0)
    visit(guard::brake,
          mode.braking ? plant::detail::affine(y.bus, y.degree, Real(1), -c.brake_off)
                       : plant::detail::affine(y.bus, y.degree, Real(-1), c.brake_on),
          y.degree, c.volt_noise);
}

}  // namespace detail

/// Guards of conduction, motion and supply. `dead`: legs whose wire is broken; `breaking`: those whose wire opens at the next
/// zero of their current.
template <class Real, class Visit>
void mode_guards(const Constants<Real>& c, const Gates& gates, const Mode& mode, unsigned dead,
                 unsigned breaking, const Expansion<Real>& y, const Series<Real>& z, Real slack,
                 Visit&& visit) {
  for (unsigned k = 0; k < 3; ++k) {
    int direction = direction_of(c.devices, mode.legs[k]);
    if (direction == 0 && (breaking >> k & 1) != 0 && y.i[k][0] != 0) direction = y.i[k][0] > 0 ? 1 : -1;
    if (direction == 0) continue;
    const Real noise = c.amp_noise * slack;
    if (direction > 0)
      visit(guard::current_zero + static_cast<int>(k), y.i[k], y.degree, noise);
    else
      visit(guard::current_zero + static_cast<int>(k),
            plant::detail::affine(y.i[k], y.degree, Real(-1), Real(0)), y.degree, noise);
  }
  detail::shaft_guards(c, mode, y, z, slack, visit);
  detail::leg_guards(c, gates, mode, dead, y, z, slack, visit);
  detail::supply_guards(c, mode, y, z, slack, visit);
}

/// The rotor stays within the present piece of the back-EMF.
template <class Real, class Visit>
void edge_guards(const Piece<Real>& piece, const Expansion<Real>& y, Visit&& visit) {
  const Real noise = noise_of(Real(base::sector_rad), Real(1));
  visit(guard::edge_ahead, plant::detail::affine(y.x, y.degree, Real(-1), piece.to), y.degree, noise);
  visit(guard::edge_behind, plant::detail::affine(y.x, y.degree, Real(1), -piece.from), y.degree, noise);
}

}  // namespace sixstep::plant::general

// SPDX-License-Identifier: Apache-2.0
// Guards of the general plant: values that are >= 0 as long as a mode is valid (plant/guards.hpp). They use
// the same series as the dynamics. A floating leg's guards compare its voltage with the two voltages at which
// the leg would begin to conduct. Without a gate the diodes determine both voltages. In an IGBT leg with a
// gate on, the transistor determines one of them (model.md 2).
#pragma once
#include "sixstep/plant/general/expand.hpp"
#include "sixstep/plant/general/leg_connections.hpp"
#include "sixstep/plant/guards.hpp"

namespace sixstep::plant::general {

namespace detail {

/// The series sign (u_0 - u), V, with the pole voltage u_0 of connection `at` without current.
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
  PerLeg<LegConnections> ways;
  for (unsigned k = 0; k < 3; ++k) ways[k] = ways_of(c.devices, gates.high[k], gates.low[k]);
  if (connected == 0) {
    for (unsigned j = 0; j < 3; ++j)
      for (unsigned k = 0; k < 3; ++k) {
        if (j == k || (dead >> j & 1) != 0 || (dead >> k & 1) != 0) continue;
        // The guard is >= 0 while e_j - e_k is too small to drive a current that enters the motor at leg k
        // and leaves it at leg j.
        series::Coefficients<Real> g = beyond(c.terms(j, ways[j].negative), y, z.pole[j], Real(1));
        const series::Coefficients<Real> low = beyond(c.terms(k, ways[k].positive), y, z.pole[k], Real(-1));
        for (int n = 0; n <= y.degree; ++n) g[n] += low[n];
        visit(guard::floating_star + 3 * static_cast<int>(j) + static_cast<int>(k), g, y.degree, noise);
      }
    return;
  }
  const auto later = [&](const series::Coefficients<Real>& of) {
    return series::tail_bound(of, y.degree) - plant::detail::abs(of[1]);
  };
  const Real bus_rest = c.inv_C > 0 ? later(y.bus) : Real(0);
  for (unsigned k = 0; k < 3; ++k) {
    if (!is_floating(mode.legs[k]) || (dead >> k & 1) != 0) continue;
    const auto& u = z.pole[k];
    const Real rest = later(u) + bus_rest;
    const auto rail = [&](int id, const PoleTerms<Real>& at, Real sign) {
      const Real start = sign * (at.bus_share * y.bus[0] + at.offset_V - u[0]),
                 slope = sign * (at.bus_share * y.bus[1] - u[1]);
      if (!series::stays_above(start, slope, rest, noise))
        visit(id + static_cast<int>(k), beyond(at, y, u, sign), y.degree, noise);
    };
    rail(guard::low_rail, c.terms(k, ways[k].positive), Real(-1));
    rail(guard::high_rail, c.terms(k, ways[k].negative), Real(1));
  }
}

template <class Real, class Visit>
void friction_guards(const Constants<Real>& c, const Mode& mode, const Expansion<Real>& y,
                     const Series<Real>& z, Real slack, Visit&& visit) {
  using plant::detail::affine;
  const Real speed_noise = c.speed_noise * plant::detail::doubt(y.w, slack);
  if (mode.motion == Motion::forward) visit(guard::standstill, y.w, y.degree, speed_noise);
  if (mode.motion == Motion::backward)
    visit(guard::standstill, affine(y.w, y.degree, Real(-1), Real(0)), y.degree, speed_noise);
  if (mode.motion != Motion::stuck) return;
  const Real noise = c.torque_noise * slack;
  visit(guard::breakaway_forward, affine(z.forward, y.degree, Real(-1), c.breakaway), y.degree, noise);
  visit(guard::breakaway_backward, affine(z.backward, y.degree, Real(1), c.breakaway), y.degree, noise);
}

/// Guards of from <= of <= to for one piece of a table. The table's first piece has no lower bound, the last
/// piece no upper bound.
template <class Real, class Pieces, class Visit>
void piece_guards(const Pieces& pieces, std::size_t at, const series::Coefficients<Real>& of, int degree,
                  int up, int down, Real noise, Visit&& visit) {
  if (at + 1 < pieces.size())
    visit(up, plant::detail::affine(of, degree, Real(-1), pieces[at].to), degree, noise);
  if (at > 0) visit(down, plant::detail::affine(of, degree, Real(1), -pieces[at].from), degree, noise);
}

template <class Real, class Visit>
void shaft_guards(const Constants<Real>& c, const Mode& mode, const Expansion<Real>& y, const Series<Real>& z,
                  Real slack, Visit&& visit) {
  using plant::detail::affine;
  if (c.dry_friction) friction_guards(c, mode, y, z, slack, visit);
  const Real load_noise = c.speed_noise * c.inv_gear * plant::detail::doubt(z.load_w, slack);
  if (c.fan != 0)
    visit(guard::load_turns, affine(z.load_w, y.degree, Real(mode.load_sign), Real(0)), y.degree, load_noise);
  if (c.lossy_gear())
    visit(guard::gear_turns, affine(z.through, y.degree, Real(mode.through_sign), Real(0)), y.degree,
          c.torque_noise * c.gear * slack);
  if (!c.over_speed.empty())
    piece_guards(c.over_speed, mode.load_piece, z.load_w, y.degree, guard::faster, guard::slower, load_noise,
                 visit);
}

/// Guard of the source's current limit I_sink. Without L_b this limit is a limit of the bus voltage: V_0 +
/// R_b I_sink.
template <class Real, class Visit>
void source_guard(const Constants<Real>& c, const Mode& mode, const Expansion<Real>& y, const Series<Real>& z,
                  Real slack, Visit&& visit) {
  if (mode.source_feeds && c.inv_L_b > 0)
    return visit(guard::source, plant::detail::affine(z.source, y.degree, Real(1), c.sink), y.degree,
                 c.amp_noise * plant::detail::doubt(z.source, slack));
  const Real sign = mode.source_feeds ? 1 : -1;
  series::Coefficients<Real> above;
  for (int n = 0; n <= y.degree; ++n) above[n] = sign * (z.open[n] - y.bus[n]);
  above[0] += sign * c.R_b * c.sink;
  visit(guard::source, above, y.degree, c.volt_noise * slack);
}

template <class Real, class Visit>
void supply_guards(const Constants<Real>& c, const Mode& mode, const Expansion<Real>& y,
                   const Series<Real>& z, Real slack, Visit&& visit) {
  using plant::detail::affine;
  if (!c.source_sinks) source_guard(c, mode, y, z, slack, visit);
  if (c.brake_conductance > 0)
    visit(guard::brake,
          mode.braking ? affine(y.bus, y.degree, Real(1), -c.brake_off)
                       : affine(y.bus, y.degree, Real(-1), c.brake_on),
          y.degree, c.volt_noise);
  piece_guards(c.open_circuit, mode.charge_piece, z.charge, y.degree, guard::fuller, guard::emptier,
               noise_of(Real(1), Real(1)), visit);
  if (c.mains_peak > 0)
    visit(guard::pulse, affine(z.phase, y.degree, Real(-1), c.mains_edge), y.degree,
          noise_of(Real(1), Real(1)));
}

/// Guards of |i_d| <= I_sat/2, the range in which the formula of the saturated flux is valid.
template <class Real, class Visit>
void saturation_guards(const Constants<Real>& c, const Expansion<Real>& y, const Series<Real>& z,
                       Visit&& visit) {
  const Real most = 1 / (2 * c.axes.inv_I_sat);
  visit(guard::saturated, plant::detail::affine(z.d, y.degree, Real(-1), most), y.degree, c.amp_noise);
  visit(guard::saturated + 1, plant::detail::affine(z.d, y.degree, Real(1), most), y.degree, c.amp_noise);
}

}  // namespace detail

/// Guards of conduction, motion and supply. `dead`: legs whose wire is broken; `breaking`: legs whose wire
/// opens at the next zero of their current.
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
  if (c.axes.inv_I_sat > 0) detail::saturation_guards(c, y, z, visit);
}

/// Guards of the present piece of the back-EMF: >= 0 while the rotor is within the piece.
template <class Real, class Visit>
void edge_guards(const Piece<Real>& piece, const Expansion<Real>& y, Visit&& visit) {
  const Real noise = noise_of(Real(base::sector_rad), Real(1));
  if (!series::stays_above(piece.to - y.x[0], -y.x[1], y.later_x, noise))
    visit(guard::edge_ahead, plant::detail::affine(y.x, y.degree, Real(-1), piece.to), y.degree, noise);
  if (!series::stays_above(y.x[0] - piece.from, y.x[1], y.later_x, noise))
    visit(guard::edge_behind, plant::detail::affine(y.x, y.degree, Real(1), -piece.from), y.degree, noise);
}

}  // namespace sixstep::plant::general

// SPDX-License-Identifier: Apache-2.0
// Guards of a mode: all guards are >= 0 as long as the present mode is valid. A guard is a polynomial
// computed from the series of the segment. It has a rounding level, below which its coefficients have no
// meaning. If several guards reach zero at the same instant, their order decides: current zero, standstill,
// sector edge, rails, then all others (model.md 4b).
#pragma once
#include "sixstep/plant/expand.hpp"
#include "sixstep/plant/pole.hpp"
#include "sixstep/series/first_root.hpp"

namespace sixstep::plant {

/// Numbers of the guards; j and k are legs. The guards of the rig have numbers from `first_free` on.
namespace guard {
inline constexpr int current_zero = 0;  // + k
inline constexpr int standstill = 3;
inline constexpr int edge_ahead = 4;
inline constexpr int edge_behind = 5;
inline constexpr int low_rail = 6;        // + k; the low diode of leg k begins to conduct
inline constexpr int high_rail = 9;       // + k; the high diode of leg k begins to conduct
inline constexpr int floating_star = 12;  // + 3 j + k: e_j - e_k reaches U_s + 2 V_f
inline constexpr int breakaway_forward = 21;
inline constexpr int breakaway_backward = 22;
inline constexpr int source = 23;
inline constexpr int brake = 24;       // this and the following guards: general kernel only
inline constexpr int load_turns = 25;  // the load's speed changes its sign
inline constexpr int gear_turns = 26;  // the torque through a lossy gear changes its sign
inline constexpr int faster = 27;      // the load's speed rises above the present piece of the torque table
inline constexpr int slower = 28;
inline constexpr int fuller = 29;  // the charge rises above the present piece of the voltage table
inline constexpr int emptier = 30;
inline constexpr int pulse = 31;      // the mains' next pulse begins
inline constexpr int saturated = 32;  // and saturated + 1: the current along the magnet's axis leaves the
                                      // range of the model
inline constexpr int first_free = 34;
}  // namespace guard

/// Rounding noise of a value: 64 eps times its scale (architecture.md, pitfall 6) times `slack`. Settling
/// raises `slack` above 1 if rounding errors make every mode inconsistent.
template <class Real>
constexpr Real noise_of(Real scale, Real slack) {
  constexpr Real eps =
      sizeof(Real) > 8 ? Real(1.08420217248550443400745280086994171e-19L) : Real(2.220446049250313e-16L);
  return 64 * eps * scale * slack;
}

namespace detail {

/// Factor on the noise of a guard. snap() has set all values at noise level to zero, so that a nonzero
/// initial value has a definite sign. Its factor is 1; otherwise a slow rotor would be neither moving nor at
/// rest. For a value that starts at zero the factor is `slack`.
template <class Real>
Real doubt(const series::Coefficients<Real>& c, Real slack) {
  return c[0] != 0 ? Real(1) : slack;
}

/// sign * c + constant, as coefficients.
template <class Real>
series::Coefficients<Real> affine(const series::Coefficients<Real>& c, int degree, Real sign, Real constant) {
  series::Coefficients<Real> out;
  out[0] = sign * c[0] + constant;
  for (int j = 1; j <= degree; ++j) out[j] = sign * c[j];
  return out;
}

/// Visits the guards of a terminal near a rail. Few segments need these guards. The function is not inlined,
/// so that the code for the other segments is short.
template <class Real, class Visit>
[[gnu::noinline]] void near_rail(const Constants<Real>& c, const PoleLaw<Real>& law, const Expansion<Real>& y,
                                 int k, bool low, bool high, Real noise, Visit&& visit) {
  const Real V_f = Real(c.devices.V_f_V);
  const series::Coefficients<Real> pole = pole_series(c, y, law);
  if (low) visit(guard::low_rail + k, affine(pole, y.degree, Real(1), V_f), y.degree, noise);
  if (!high) return;
  series::Coefficients<Real> g;
  g[0] = y.bus[0] - pole[0] + V_f;
  for (int j = 1; j <= y.degree; ++j) g[j] = y.bus[j] - pole[j];
  visit(guard::high_rail + k, g, y.degree, noise);
}

template <class Real, class Visit>
[[gnu::always_inline]] inline void rail_guards(const Constants<Real>& c, const PoleLaw<Real>& law,
                                               const Expansion<Real>& y, int k, Real noise, Visit&& visit) {
  const Real V_f = Real(c.devices.V_f_V);
  const Real bus_rest = c.inv_C > 0 ? series::tail_bound(y.bus, y.degree) - abs(y.bus[1]) : Real(0);
  const PoleOutline<Real> is = pole_outline(c, y, law, bus_rest);
  const bool low = !series::stays_above(is.start + V_f, is.slope, is.rest, noise);
  const bool high =
      // mutant: y.bus[0] + V_f - is.start => y.bus[0] + 2 * V_f - is.start
      // mutant: y.bus[1] - is.slope => -is.slope
      !series::stays_above(y.bus[0] + V_f - is.start, y.bus[1] - is.slope, is.rest + bus_rest, noise);
  if (low || high) near_rail(c, law, y, k, low, high, noise, visit);
}

/// Guards if no leg is connected: conduction starts when max e - min e > U_s + 2 V_f, with back-EMFs e, bus
/// voltage U_s and diode drop V_f.
template <class Real, class Visit>
void floating_star_guards(const Constants<Real>& c, const EmfPiece<Real>& piece, const LegsLaw<Real>& law,
                          const Expansion<Real>& y, Real noise, Visit&& visit) {
  const Real bus_rest = c.inv_C > 0 ? series::tail_bound(y.bus, y.degree) - abs(y.bus[1]) : Real(0);
  PerLeg<PoleOutline<Real>> is;
  for (unsigned k = 0; k < 3; ++k) is[k] = pole_outline(c, y, pole_law(piece, law, k), bus_rest);
  const Real room = y.bus[0] + 2 * Real(c.devices.V_f_V);
  for (unsigned j = 0; j < 3; ++j)
    for (unsigned k = 0; k < 3; ++k) {
      if (j == k ||
          series::stays_above(room - is[j].start + is[k].start, y.bus[1] - is[j].slope + is[k].slope,
                              is[j].rest + is[k].rest + bus_rest, noise))
        continue;
      const series::Coefficients<Real> high = pole_series(c, y, pole_law(piece, law, j)),
                                       low = pole_series(c, y, pole_law(piece, law, k));
      series::Coefficients<Real> g;
      // mutant: 2 * Real(c.devices.V_f_V) => Real(c.devices.V_f_V)
      g[0] = y.bus[0] - high[0] + low[0] + 2 * Real(c.devices.V_f_V);
      for (int n = 1; n <= y.degree; ++n) g[n] = y.bus[n] - high[n] + low[n];
      visit(guard::floating_star + 3 * static_cast<int>(j) + static_cast<int>(k), g, y.degree, noise);
    }
}

template <class Real, class Visit>
void rotor_guards(const Constants<Real>& c, const Mode& mode, const Expansion<Real>& y, Real slack,
                  Visit&& visit) {
  const Real torque_noise = c.torque_noise * slack;
  const Real speed_noise = c.speed_noise * doubt(y.w, slack);
  if (mode.motion == Motion::forward)
    visit(guard::standstill, y.w, y.degree, speed_noise);
  else if (mode.motion == Motion::backward)
    visit(guard::standstill, affine(y.w, y.degree, Real(-1), Real(0)), y.degree, speed_noise);
  else if (mode.motion == Motion::stuck) {
    const auto [load, dry, per_speed] = torques(c, Motion::stuck);  // at rest B w is zero, and the breakaway
                                                                    // torque replaces dry friction
    // mutant: c.breakaway + load => c.breakaway - load
    visit(guard::breakaway_forward, affine(y.torque, y.degree, Real(-1), c.breakaway + load), y.degree,
          torque_noise);
    visit(guard::breakaway_backward, affine(y.torque, y.degree, Real(1), c.breakaway - load), y.degree,
          torque_noise);
  }
}

/// Guard of a leg that conducts by a diode: >= 0 while the current has the diode's direction.
template <class Real, class Visit>
[[gnu::always_inline]] inline void diode_guard(Connection diode, const Expansion<Real>& y, int k, Real noise,
                                               Visit&& visit) {
  const series::Coefficients<Real>& i = y.i[k];
  const Real start = along_diode(diode, i[0]), slope = along_diode(diode, i[1]);
  if (series::stays_above(start, slope, y.reach_i[k] - abs(slope), noise)) return;
  if (diode == Connection::low_diode)
    visit(guard::current_zero + k, i, y.degree, noise);
  else
    visit(guard::current_zero + k, affine(i, y.degree, Real(-1), Real(0)), y.degree, noise);
}

}  // namespace detail

/// Guards of conduction, motion and supply. settle() checks a mode by the same guards.
template <class Real, class Visit>
void mode_guards(const Constants<Real>& c, const Mode& mode, const Expansion<Real>& y, Real slack,
                 Visit&& visit) {
  const LegsLaw<Real>& law = c.legs[legs_index(mode.legs)];
  const Real volt_noise = c.volt_noise * slack;
  if (law.diodes != 0) {
    const Real amp_noise = c.amp_noise * slack;
    for (int k = 0; k < 3; ++k)
      if (law.diodes >> k & 1) detail::diode_guard(mode.legs[k], y, k, amp_noise, visit);
  }
  if (c.dry_friction) detail::rotor_guards(c, mode, y, slack, visit);
  if (law.floating != 0) {
    const EmfPiece<Real>& piece = c.emf[mode.sector].piece[mode.piece];
    if (law.connected == 0) {
      detail::floating_star_guards(c, piece, law, y, volt_noise, visit);
    } else {
      for (unsigned k = 0; k < 3; ++k)
        if (law.floating >> k & 1)
          detail::rail_guards(c, pole_law(piece, law, k), y, static_cast<int>(k), volt_noise, visit);
    }
  }
  if (!c.source_sinks)
    visit(guard::source,
          mode.source_feeds ? detail::affine(y.bus, y.degree, Real(-1), c.V_0)
                            : detail::affine(y.bus, y.degree, Real(1), -c.V_0),
          y.degree, volt_noise);
}

/// Guards of the present piece of the back-EMF: both are >= 0 while the rotor is within the piece.
template <class Real, class Visit>
void edge_guards(const EmfPiece<Real>& piece, const Expansion<Real>& y, Visit&& visit) {
  const Real noise = noise_of(Real(base::sector_rad), Real(1));
  if (!series::stays_above(piece.to - y.x[0], -y.x[1], y.later_x, noise))
    visit(guard::edge_ahead, detail::affine(y.x, y.degree, Real(-1), piece.to), y.degree, noise);
  // mutant: y.x[0] - piece.from => y.x[0]
  if (!series::stays_above(y.x[0] - piece.from, y.x[1], y.later_x, noise))
    visit(guard::edge_behind, detail::affine(y.x, y.degree, Real(1), -piece.from), y.degree, noise);
}

}  // namespace sixstep::plant

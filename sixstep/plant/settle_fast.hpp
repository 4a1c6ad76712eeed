// SPDX-License-Identifier: Apache-2.0
// Settles the mode without trials (model.md 2), after nearly all events: gates and currents determine the
// connections, and the voltages of open legs are clearly inside or outside the rails. settle.hpp handles the
// other events.
#pragma once
#include "sixstep/plant/guards.hpp"

namespace sixstep::plant {

namespace detail {

/// Basis functions phi0 and phi1 of the back-EMF's shape at the rotor's position (back_emf.hpp).
template <class Real>
void shape_at(const Constants<Real>& c, const State<Real>& s, Real& phi0, Real& phi1) {
  phi0 = 1;
  phi1 = s.x;
  if (c.sine) {
    phi0 = static_cast<Real>(base::cos(static_cast<double>(s.x)));
    phi1 = static_cast<Real>(base::sin(static_cast<double>(s.x)));
  }
}

/// Writes the connections that gates and currents determine. Returns a mask of the other legs, which are
/// called open.
template <class Real>
unsigned named_legs(const State<Real>& s, const Gates& gates, Real noise, Legs& legs) {
  unsigned open = 0;
  for (unsigned k = 0; k < 3; ++k) {
    legs[k] = connection_of(gates.high[k], gates.low[k], s.i[k], noise);
    if (is_floating(legs[k])) open |= 1U << k;
  }
  return open;
}

/// Settles leg k, which is open while the other two legs conduct. Leg k floats if its voltage u_n + e_k is
/// within the rails. If the voltage is beyond a rail, leg k conducts by the diode to this rail; L di_k/dt is
/// then two thirds of the excess voltage. Returns false if the voltage is too close to a rail.
template <class Real>
bool settle_third_leg(const Constants<Real>& c, const State<Real>& s, const EmfPiece<Real>& piece, unsigned k,
                      Legs& legs) {
  Real phi0, phi1;
  shape_at(c, s, phi0, phi1);
  const Real free = free_voltage(pole_law(piece, c.legs[legs_index(legs)], k), s.bus, s.i, s.w, phi0, phi1);
  const Real V_f = Real(c.devices.V_f_V), noise = c.volt_noise;
  // mutant: s.bus + V_f - free => s.bus - free
  const Real above_low = free + V_f, below_high = s.bus + V_f - free;
  if ((above_low > noise) & (below_high > noise)) return true;
  if (above_low < -2 * noise)
    legs[k] = Connection::low_diode;
  else if (below_high < -2 * noise)
    legs[k] = Connection::high_diode;
  else
    return false;
  return true;
}

/// Settles two open legs while the third leg's switch is on. Returns true if both voltages are clearly within
/// the rails, so that both legs float. Otherwise returns false, because a leg that conducts may cause the
/// second open leg to conduct too.
template <class Real>
[[gnu::noinline]] bool two_legs_float(const Constants<Real>& c, const State<Real>& s, const Mode& m,
                                      unsigned open) {
  const EmfPiece<Real>& piece = c.emf[m.sector].piece[m.piece];
  Real phi0, phi1;
  shape_at(c, s, phi0, phi1);
  const Real V_f = Real(c.devices.V_f_V), noise = c.volt_noise;
  bool clear = true;
  for (unsigned k = 0; k < 3; ++k) {
    if ((open >> k & 1) == 0) continue;
    const Real free =
        free_voltage(pole_law(piece, c.legs[legs_index(m.legs)], k), s.bus, s.i, s.w, phi0, phi1);
    clear = clear && s.i[k] == 0 && free + V_f > noise && s.bus + V_f - free > noise;
  }
  return clear;
}

}  // namespace detail

/// Settles the most frequent cases without enumeration:
/// - gates and currents determine all connections,
/// - one leg is open while the other two legs conduct,
/// - two legs are open, and their voltages are clearly within the rails.
/// Returns false in all other cases, and if a value is too close to zero or to a rail.
template <class Real>
bool settle_fast(const Constants<Real>& c, const State<Real>& s, const Gates& gates, Mode& mode) {
  Motion motion = c.locked ? Motion::locked : Motion::free;
  if (c.dry_friction) {
    // mutant: detail::abs(s.w) <= c.speed_noise => false
    if (detail::abs(s.w) <= c.speed_noise) return false;
    motion = motion_at(s.w);
  }
  // The connections are written directly into `mode`. A local copy would be read back before its single bytes
  // have reached memory, which stalls the processor.
  Legs& legs = mode.legs;
  const unsigned open = detail::named_legs(s, gates, c.amp_noise, legs);
  if ((open & (open - 1)) != 0) {
    // mutant: open == 7 || !detail::two_legs_float(c, s, mode, open) => open == 7
    if (open == 7 || !detail::two_legs_float(c, s, mode, open)) return false;
  } else if (open != 0) {
    const unsigned k = open >> 1;  // index of the open leg
    // mutant: s.i[k] != 0 => false
    if (s.i[k] != 0) return false;
    if (!detail::settle_third_leg(c, s, c.emf[mode.sector].piece[mode.piece], k, legs)) return false;
  }
  if (!c.source_sinks) return false;
  mode.motion = motion;
  mode.source_feeds = true;
  return true;
}

}  // namespace sixstep::plant

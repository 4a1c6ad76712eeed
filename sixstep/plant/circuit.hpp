// SPDX-License-Identifier: Apache-2.0
// Circuit equations of the three-leg bridge with a star winding (model.md 2): connection of each leg, pole
// voltages, and star point's voltage. settle.hpp determines the connections that do not follow from gates and
// currents.
#pragma once
#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

#include "sixstep/plant/machine.hpp"

namespace sixstep::plant {

/// Connection of a phase's terminal. A leg has exactly one connection at any time.
enum class Connection : std::uint8_t { floating, high_switch, low_switch, high_diode, low_diode };

/// The connections of legs a, b, c.
using Legs = std::array<Connection, 3>;

/// Quantities of the three phases by index, for loops over the legs.
template <class Real>
using PerLeg = std::array<Real, 3>;

constexpr bool is_floating(Connection c) { return c == Connection::floating; }
constexpr bool is_high(Connection c) { return c == Connection::high_switch || c == Connection::high_diode; }
constexpr bool is_low(Connection c) { return c == Connection::low_switch || c == Connection::low_diode; }
constexpr bool is_diode(Connection c) { return c == Connection::high_diode || c == Connection::low_diode; }

/// |S|: number of connected legs.
constexpr int connected_count(const Legs& legs) {
  return int{!is_floating(legs[0])} + int{!is_floating(legs[1])} + int{!is_floating(legs[2])};
}

/// Table of model.md 2 for a MOSFET leg. A channel that is switched on conducts both directions of current,
/// and its diode conducts no current. Without a gate, the current's sign selects the diode. With a current of
/// at most `noise` the leg is floating, unless settle() finds from the voltages that a diode conducts. Both
/// gates on are a shoot-through, which has no connection: call shoots_through() first. The function uses
/// branches, because the processor predicts them and can begin a segment's series before the signs of the
/// currents are computed.
template <class Real>
constexpr Connection connection_of(bool gate_high, bool gate_low, Real current, Real noise = 0) {
  if (gate_high) return Connection::high_switch;
  if (gate_low) return Connection::low_switch;
  if (current > noise) return Connection::low_diode;
  return current < -noise ? Connection::high_diode : Connection::floating;
}

/// v for a leg on its low diode, -v for a leg on its high diode: for a current v, the result is positive if
/// the diode can conduct it.
template <class Real>
constexpr Real along_diode(Connection diode, Real v) {
  return diode == Connection::low_diode ? v : -v;
}

/// Pole voltage of a connected leg, V against the negative rail: u_k = bus_share U_s + offset_V - r_ohm i_k.
template <class Real>
struct PoleTerms {
  Real bus_share{};  ///< 1 on the positive rail, 0 on the negative rail
  Real offset_V{};
  Real r_ohm{};
};

/// Pole terms of a connection (model.md 2):
///   high switch: U_s - R_on i       low switch: -R_on i
///   high diode:  U_s + V_f - r_d i  low diode:  -V_f - r_d i
/// The equations do not determine the pole voltage of a floating leg from its devices: all terms are zero.
template <class Real>
constexpr PoleTerms<Real> pole_terms(Connection c, const Devices& devices) {
  const Real R_on = Real(devices.R_on_ohm), V_f = Real(devices.V_f_V), r_d = Real(devices.r_d_ohm);
  switch (c) {
    case Connection::high_switch:
      return {Real(1), Real(0), R_on};
    case Connection::low_switch:
      return {Real(0), Real(0), R_on};
    case Connection::high_diode:
      return {Real(1), V_f, r_d};
    case Connection::low_diode:
      return {Real(0), -V_f, r_d};
    case Connection::floating:
      break;
  }
  return {};
}

/// Pole terms of each Connection.
template <class Real>
using PoleTable = std::array<PoleTerms<Real>, 5>;

template <class Real>
constexpr PoleTable<Real> pole_table(const Devices& devices) {
  PoleTable<Real> table;
  for (std::size_t k = 0; k < table.size(); ++k)
    table[k] = pole_terms<Real>(static_cast<Connection>(k), devices);
  return table;
}

/// Pole voltage, V against the negative rail, of a connected leg that carries i, A.
template <class Real>
constexpr Real pole_voltage(const PoleTerms<Real>& terms, Real U_s, Real i) {
  return terms.bus_share * U_s + terms.offset_V - terms.r_ohm * i;
}

/// Star point's voltage, V against the negative rail (model.md (5)): u_n = (1/|S|) sum_{k in S} (u_k - e_k).
/// S is the set of connected legs, u_k a pole voltage, e_k a back-EMF. With |S| = 0 the voltage is undefined.
/// The function then centres the terminals between the rails, so that a floating terminal lies beyond a rail
/// exactly if max e - min e > U_s + 2 V_f.
template <class Real>
constexpr Real star_voltage(const Legs& legs, const PoleTable<Real>& poles, Real U_s, const PerLeg<Real>& i,
                            const PerLeg<Real>& e) {
  Real sum{};
  int connected = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    if (is_floating(legs[k])) continue;
    sum += pole_voltage(poles[static_cast<std::size_t>(legs[k])], U_s, i[k]) - e[k];
    ++connected;
  }
  if (connected > 0) return sum / Real(connected);
  const Real highest = std::max({e[0], e[1], e[2]}), lowest = std::min({e[0], e[1], e[2]});
  // mutant: (U_s - highest - lowest) / Real(2) => (U_s + highest + lowest) / Real(2)
  return (U_s - highest - lowest) / Real(2);
}

/// All three pole voltages (model.md 2). The devices determine the voltage of a connected leg. The voltage of
/// a floating leg is u_n + e_k.
template <class Real>
constexpr PerLeg<Real> pole_voltages(const Legs& legs, const PoleTable<Real>& poles, Real U_s,
                                     const PerLeg<Real>& i, const PerLeg<Real>& e) {
  const Real u_n = star_voltage(legs, poles, U_s, i, e);
  PerLeg<Real> u{};
  for (std::size_t k = 0; k < 3; ++k)
    u[k] =
        is_floating(legs[k]) ? u_n + e[k] : pole_voltage(poles[static_cast<std::size_t>(legs[k])], U_s, i[k]);
  return u;
}

/// Current out of the positive rail: the sum of i_k over the legs connected high, by switch or diode
/// (model.md 2).
template <class Real>
constexpr Real bus_current(const Legs& legs, const PerLeg<Real>& i) {
  Real sum{};
  for (std::size_t k = 0; k < 3; ++k)
    if (is_high(legs[k])) sum += i[k];
  return sum;
}

}  // namespace sixstep::plant

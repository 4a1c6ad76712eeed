// SPDX-License-Identifier: Apache-2.0
// Integrates the energies of bridge, winding and shaft over one segment, using the segment's series. These
// energies are the terms of the energy balance (model.md 5). Terms that are zero are not computed.
#pragma once
#include "sixstep/plant/plant.hpp"
#include "sixstep/series/quadrature.hpp"

namespace sixstep::plant {

/// Energies over one segment, J. Friction has two parts, `viscous` and `dry`. `load_viscous` is the part of
/// `viscous` at the load's side. `travel` is the rotation of the shaft, rad.
template <class Real>
struct SegmentEnergy {
  Real supplied = 0, copper = 0, devices = 0, air_gap = 0, viscous = 0, dry = 0, load = 0, travel = 0,
       load_viscous = 0;
};

namespace detail {

inline namespace SIXSTEP_LANES {

/// Integrated quantities at the nodes: currents of the first and second connected leg, speed and torque.
template <int points, class Real>
struct Moving {
  series::Nodes<points, Real> i_1{}, i_2{}, w{}, torque{};
};

/// Integrals in units of the segment's length. `square` and `charge`: squared currents and currents of the
/// connected legs, in the order of LegsLaw. `turn`: speed; `turn_square`: squared speed; `air_gap`: air-gap
/// power.
template <class Real>
struct Integrals {
  PerLeg<Real> square{}, charge{};
  Real turn = 0, turn_square = 0, air_gap = 0;
};

/// Says which terms exist in a segment. If a member is a compile-time constant, the compiler removes the code
/// of absent terms.
template <class Real>
struct Moves {
  unsigned connected;  ///< number of connected legs
  bool turning;
  bool steady;        ///< true: the torque is proportional to the first leg's current
  Real torque_per_A;  ///< N m per ampere of the first connected leg, if `steady`

  [[gnu::always_inline]] bool conducts() const { return connected >= 2; }
};

/// One or two series of currents suffice: with three connected legs i_c = -(i_a + i_b), with two i_b = -i_a.
/// Four sums computed at once need little more time than two.
template <int points, class Real>
[[gnu::always_inline]] inline Integrals<Real> integrals(const Moves<Real>& moves,
                                                        const Moving<points, Real>& at) {
  using series::total, series::totals, series::weighted;
  Integrals<Real> out;
  const auto w = weighted<points>(at.w), i_1 = weighted<points>(at.i_1);
  if (moves.connected == 3) {
    const auto i_2 = weighted<points>(at.i_2);
    const auto i_3 = at.i_1 + at.i_2, weighted_3 = i_1 + i_2;
    const auto products = totals(i_1 * at.i_1, i_2 * at.i_2, weighted_3 * i_3, w * at.torque);
    const auto others = totals(i_1, i_2, w, w * at.w);
    out.square = {products.of[0], products.of[1], products.of[2]};
    out.charge = {others.of[0], others.of[1], -(others.of[0] + others.of[1])};
    out.air_gap = products.of[3];
    out.turn = others.of[2];
    out.turn_square = others.of[3];
    return out;
  }
  const auto sums = totals(i_1 * at.i_1, i_1, w, w * at.w);
  out.square = {sums.of[0], sums.of[0], 0};
  out.charge = {sums.of[1], -sums.of[1], 0};
  out.turn = sums.of[2];
  out.turn_square = sums.of[3];
  out.air_gap = moves.steady ? moves.torque_per_A * total(i_1 * at.w) : total(w * at.torque);
  return out;
}

/// Computes the energies that depend on the currents: copper, devices and supply. `dt`: length of the
/// interval, s.
template <int points, class Real>
[[gnu::always_inline]] inline void electrical_energy(const Constants<Real>& c, const LegsLaw<Real>& law,
                                                     const Expansion<Real>& y, Real dt,
                                                     const series::Nodes<points, Real>& s,
                                                     const Moving<points, Real>& at,
                                                     const Integrals<Real>& legs, SegmentEnergy<Real>& out) {
  // If the third leg floats, both integrals of that leg are zero.
  const PerLeg<PoleTerms<Real>>& pole = law.pole;
  const auto device = [&](int n) {
    // mutant: pole[n].r_ohm * legs.square[n] - pole[n].offset_V * legs.charge[n] => pole[n].r_ohm * legs.square[n] + pole[n].offset_V * legs.charge[n]
    return pole[n].r_ohm * legs.square[n] - pole[n].offset_V * legs.charge[n];
  };
  const auto drawn = [&](int n) { return pole[n].bus_share * legs.charge[n]; };
  out.copper = dt * c.R * (legs.square[0] + legs.square[1] + legs.square[2]);
  out.devices = dt * ((device(0) + device(1)) + device(2));
  if (!(c.inv_C > 0)) {
    out.supplied = dt * y.bus[0] * ((drawn(0) + drawn(1)) + drawn(2));
    return;
  }
  const Real share = pole[2].bus_share;  // i_3 = -(i_1 + i_2)
  const auto dc = (pole[0].bus_share - share) * at.i_1 + (pole[1].bus_share - share) * at.i_2;
  out.supplied = dt * series::weighted_sum<points>(series::values_at<points>(y.bus, y.degree, s), dc);
}

/// Computes the energies that depend on the rotation, and the air-gap energy.
template <class Real>
[[gnu::always_inline]] inline void shaft_energy(const Constants<Real>& c, const Mode& mode, Real dt,
                                                const Integrals<Real>& of, SegmentEnergy<Real>& out) {
  const auto [load, dry, per_speed] = torques(c, mode.motion);
  out.travel = dt * of.turn;
  out.load = load * out.travel;
  // mutant: dry * out.travel => -dry * out.travel
  out.dry = dry * out.travel;
  out.viscous = dt * per_speed * of.turn_square;
  out.air_gap = dt * of.air_gap;
}

/// Values at all nodes, of the series that are needed for `moves`.
template <int points, class Real>
[[gnu::always_inline]] inline Moving<points, Real> moving_at(const LegsLaw<Real>& law,
                                                             const Moves<Real>& moves,
                                                             const Expansion<Real>& y,
                                                             const series::Nodes<points, Real>& s) {
  const auto values = [&](const series::Coefficients<Real>& c) __attribute__((always_inline)) {
    return series::values_of_fitting<points>(c, y.degree, s);
  };
  Moving<points, Real> at;
  if (moves.conducts()) {
    at.i_1 = values(y.i[law.leg[0]]);
    at.i_2 = moves.connected == 3 ? values(y.i[law.leg[1]]) : -at.i_1;
  }
  if (moves.turning) at.w = values(y.w);
  if (moves.conducts() && moves.turning && !moves.steady) at.torque = values(y.torque);
  return at;
}

template <int points, class Real>
[[gnu::always_inline]] inline SegmentEnergy<Real> energy_of(const Plant<Real>& plant,
                                                            const LegsLaw<Real>& law,
                                                            const Moves<Real>& moves, Real to) {
  const Constants<Real>& c = plant.constants();
  const Expansion<Real>& y = plant.expansion();
  SegmentEnergy<Real> out;
  const auto s = series::nodes_up_to<points>(to);
  const auto at = moving_at<points>(law, moves, y, s);
  const Real dt = y.h * to;
  const Integrals<Real> of = integrals<points>(moves, at);
  if (moves.conducts()) electrical_energy<points>(c, law, y, dt, s, at, of, out);
  if (moves.turning) shaft_energy(c, plant.mode(), dt, of, out);
  return out;
}

/// Torque per ampere of the first leg, N m/A, if two legs are connected and the difference of their back-EMFs
/// per speed is constant; else 0.
template <class Real>
[[gnu::always_inline]] inline Real steady_torque_per_A(const Constants<Real>& c, const Mode& mode,
                                                       const LegsLaw<Real>& law) {
  if (law.connected != 2 || c.sine) return 0;
  const EmfPiece<Real>& piece = c.emf[mode.sector].piece[mode.piece];
  const int j = law.leg[0], k = law.leg[1];
  // mutant: piece.beta[j] == piece.beta[k] => true
  return piece.beta[j] == piece.beta[k] ? piece.alpha[j] - piece.alpha[k] : Real(0);
}

/// Energies of a segment. In nearly all segments the rotor turns, with two legs on their flat tops or with
/// three connected legs: for each of these two cases the compiler makes code without further branches.
template <class Real>
[[gnu::always_inline]] inline SegmentEnergy<Real> segment_energy_here(const Plant<Real>& plant, Real to) {
  const Constants<Real>& c = plant.constants();
  const Mode& mode = plant.mode();
  const LegsLaw<Real>& law = c.legs[legs_index(mode.legs)];
  const bool turning = turns(mode.motion);
  const unsigned connected = law.connected;
  if (connected < 2 && !turning) return {};
  const Real per_A = steady_torque_per_A(c, mode, law);
  return series::with_points_for(
      plant.expansion().degree, [&]<int points>() __attribute__((always_inline)) {
        if (turning && connected == 3)
          return energy_of<points>(plant, law, Moves<Real>{3, true, false, 0}, to);
        if (turning && per_A != 0)
          return energy_of<points>(plant, law, Moves<Real>{2, true, true, per_A}, to);
        return energy_of<points>(plant, law, Moves<Real>{connected, turning, false, 0}, to);
      });
}

}  // namespace SIXSTEP_LANES

}  // namespace detail

/// Energies of the present segment, J, from its start to the fraction `to`, 0 to 1. The error of each
/// integral is about 2^-53 of its scale (series/quadrature.hpp).
template <class Real>
SegmentEnergy<Real> segment_energy(const Plant<Real>& plant, Real to) {
  return detail::segment_energy_here(plant, to);
}
/// The version for double is compiled once, for any processor. The audit's version for processors with AVX
/// returns the same bits (plant/audit_avx.cpp).
SegmentEnergy<double> segment_energy(const Plant<double>& plant, double to);

}  // namespace sixstep::plant

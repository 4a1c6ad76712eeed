// SPDX-License-Identifier: Apache-2.0
// A LegsLaw contains the coefficients for the slopes of the currents and for the star point's voltage, for
// one set of connections. These are the electrical equations of model.md 1 and 2 without the back-EMF. The
// coefficients are computed once per plant.
#pragma once
#include "sixstep/plant/circuit.hpp"

namespace sixstep::plant {

template <class Real>
struct LegsLaw {
  /// A quantity as a weighted sum of U_s, 1, i and i_2. i and i_2 are the currents of the first and second
  /// connected leg.
  struct Terms {
    Real bus = 0, offset = 0, i = 0, i_2 = 0;  ///< weights of U_s, 1, i and i_2
  };
  std::array<std::uint8_t, 3> leg{0, 1, 2};  ///< first the connected legs in order, then the floating legs
  std::uint8_t connected = 0;
  std::uint8_t floating = 0, diodes = 0;  ///< as masks: bit k is leg k
  PerLeg<PoleTerms<Real>> pole{};         ///< pole terms in the order of `leg`; zero for a floating leg
  PerLeg<Real> along{};  ///< in the order of `leg`: sign of a current that the leg's diode conducts; 0: no
                         ///< diode conducts
  Terms slope, slope_2;  ///< di/dt of i and, if three legs are connected, of i_2
  Terms star;            ///< u_n plus the mean of e over the connected legs, for one or two connected legs
  Real emf_rate = 0;     ///< factor of the back-EMF in di/dt: -emf_rate (e_j - e_k) with two legs j, k,
                         ///< -emf_rate (e_k - mean of e) with three legs
};

/// One law per set of connections, indexed by legs_index().
template <class Real>
using LegsLaws = std::array<LegsLaw<Real>, 125>;

constexpr std::size_t legs_index(const Legs& legs) {
  return 25 * static_cast<std::size_t>(legs[0]) + 5 * static_cast<std::size_t>(legs[1]) +
         static_cast<std::size_t>(legs[2]);
}

namespace detail {

/// Law of two connected legs j, k, whose currents are i and -i: 2 L di/dt = u_j - u_k - 2 R i - (e_j - e_k).
template <class Real>
void pair_law(const PoleTerms<Real>& a, const PoleTerms<Real>& b, Real R, Real inv_L, LegsLaw<Real>& law) {
  law.emf_rate = inv_L / 2;
  law.slope = {.bus = law.emf_rate * (a.bus_share - b.bus_share),
               .offset = law.emf_rate * (a.offset_V - b.offset_V),
               // mutant: 2 * R + a.r_ohm + b.r_ohm => 2 * R + 2 * a.r_ohm
               .i = -law.emf_rate * (2 * R + a.r_ohm + b.r_ohm)};
  law.star = {.bus = (a.bus_share + b.bus_share) / 2,
              .offset = (a.offset_V + b.offset_V) / 2,
              // mutant: (b.r_ohm - a.r_ohm) / 2 => (a.r_ohm - b.r_ohm) / 2
              .i = (b.r_ohm - a.r_ohm) / 2};
}

/// Law of three connected legs: L di_k/dt = v_k - mean of v, with v_k = u_k - R i_k - e_k. The third current
/// is eliminated.
template <class Real>
void three_leg_law(const PerLeg<PoleTerms<Real>>& terms, Real R, Real inv_L, LegsLaw<Real>& law) {
  constexpr Real third = Real(1.0L / 3);
  const auto slope = [&](std::size_t k) {
    const auto own = [&](std::size_t m) {
      return inv_L * (R + terms[m].r_ohm) * ((m == k ? Real(1) : Real(0)) - third);
    };
    const auto above_mean = [&](Real PoleTerms<Real>::*v) {
      return inv_L * (terms[k].*v - (terms[0].*v + terms[1].*v + terms[2].*v) * third);
    };
    return typename LegsLaw<Real>::Terms{.bus = above_mean(&PoleTerms<Real>::bus_share),
                                         .offset = above_mean(&PoleTerms<Real>::offset_V),
                                         .i = own(2) - own(0),
                                         // mutant: own(2) - own(1) => own(2) - own(0)
                                         .i_2 = own(2) - own(1)};
  };
  law.emf_rate = inv_L;
  law.slope = slope(0);
  law.slope_2 = slope(1);
}

}  // namespace detail

template <class Real>
LegsLaw<Real> legs_law(const Legs& legs, const Devices& devices, Real R, Real inv_L) {
  LegsLaw<Real> law;
  std::uint8_t back = 3;
  for (std::uint8_t k = 3; k-- > 0;)
    if (is_floating(legs[k])) law.leg[--back] = k;
  for (std::uint8_t k = 0; k < 3; ++k) {
    const auto bit = static_cast<std::uint8_t>(1U << k);
    if (!is_floating(legs[k])) law.leg[law.connected++] = k;
    if (is_floating(legs[k])) law.floating |= bit;
    if (is_diode(legs[k])) law.diodes |= bit;
  }
  PerLeg<PoleTerms<Real>>& terms = law.pole;
  for (std::size_t n = 0; n < 3; ++n) {
    const Connection connection = legs[law.leg[n]];
    terms[n] = pole_terms<Real>(connection, devices);
    if (is_diode(connection)) law.along[n] = along_diode(connection, Real(1));
  }
  if (law.connected == 1) law.star = {.bus = terms[0].bus_share, .offset = terms[0].offset_V};
  if (law.connected == 2) detail::pair_law(terms[0], terms[1], R, inv_L, law);
  if (law.connected == 3) detail::three_leg_law(terms, R, inv_L, law);
  return law;
}

template <class Real>
LegsLaws<Real> legs_laws(const Devices& devices, Real R, Real inv_L) {
  LegsLaws<Real> laws;
  for (std::uint8_t n = 0; n < 125; ++n) {
    const Legs legs{static_cast<Connection>(n / 25), static_cast<Connection>(n / 5 % 5),
                    static_cast<Connection>(n % 5)};
    laws[n] = legs_law(legs, devices, R, inv_L);
  }
  return laws;
}

}  // namespace sixstep::plant

// SPDX-License-Identifier: Apache-2.0
// Voltages of the three terminals against the negative rail, including floating terminals: these are the
// inputs of the board's dividers. If all legs float, the voltages are centred between the rails
// (circuit.hpp).
#pragma once
#include "sixstep/plant/general/plant.hpp"
#include "sixstep/plant/plant.hpp"

namespace sixstep::plant {

/// Terminal voltages, V, in the plant's present state, before the gates of this instant take effect.
template <class Real>
PerLeg<Real> terminal_voltages(const Plant<Real>& plant) {
  const State<Real>& now = plant.state();
  const PerLeg<Real> e = detail::back_emf(plant.constants(), now, plant.mode());
  return pole_voltages(plant.mode().legs, plant.constants().poles, now.bus, now.i, e);
}

/// With saliency and harmonics the star point's voltage can only be computed from the series. The function
/// therefore expands a copy of the plant. The cost is acceptable, because terminals are read once per control
/// tick.
template <class Real>
PerLeg<Real> terminal_voltages(const general::Plant<Real>& plant) {
  general::Plant<Real> now = plant;
  constexpr double moment_s = 1e-9;
  if (now.expand(moment_s) < 0) return {};
  return now.at(0).pole;
}

template <class Real>
using TerminalSeries = PerLeg<series::Coefficients<Real>>;

namespace detail {

/// Centres the terminals u[k] = e_k between the rails if no leg is connected. The highest and the lowest
/// terminal are determined in the middle of [0, s]. `dead`: mask of the legs with broken wires.
template <class Real>
void centre(const Expansion<Real>& y, Real s, TerminalSeries<Real>& u, unsigned dead = 0) {
  PerLeg<Real> middle;
  for (std::size_t k = 0; k < 3; ++k) middle[k] = series::evaluate(u[k], y.degree, s / 2);
  const general::StarEnds ends = general::star_ends(middle, dead);
  for (int n = 0; n <= y.degree; ++n) {
    const Real star = (y.bus[n] - u[ends.high][n] - u[ends.low][n]) / 2;
    for (std::size_t k = 0; k < 3; ++k) u[k][n] += star;
  }
}

}  // namespace detail

/// Terminal voltages as series, valid for the fraction 0 to s of the segment that was expanded last. After
/// this part the connections may differ.
template <class Real>
TerminalSeries<Real> terminal_series(const Plant<Real>& plant, Real s) {
  const Constants<Real>& c = plant.constants();
  const Expansion<Real>& y = plant.expansion();
  const Mode& mode = plant.mode();
  const LegsLaw<Real>& law = c.legs[legs_index(mode.legs)];
  const EmfPiece<Real>& piece = c.emf[mode.sector].piece[mode.piece];
  TerminalSeries<Real> u;
  for (unsigned k = 0; k < 3; ++k) {
    if (is_floating(mode.legs[k])) {
      u[k] = pole_series(c, y, pole_law(piece, law, k));
      continue;
    }
    const PoleTerms<Real>& terms = c.poles[static_cast<std::size_t>(mode.legs[k])];
    for (int n = 0; n <= y.degree; ++n) u[k][n] = terms.bus_share * y.bus[n] - terms.r_ohm * y.i[k][n];
    u[k][0] += terms.offset_V;
  }
  if (law.connected == 0) detail::centre(y, s, u);
  return u;
}

template <class Real>
TerminalSeries<Real> terminal_series(const general::Plant<Real>& plant, Real s) {
  TerminalSeries<Real> u = plant.series().pole;
  if (connected_count(plant.mode().legs) == 0) detail::centre(plant.expansion(), s, u, plant.dead());
  return u;
}

}  // namespace sixstep::plant

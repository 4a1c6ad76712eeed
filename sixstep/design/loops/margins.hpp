// SPDX-License-Identifier: Apache-2.0
// Computes the stability margins of a single loop in closed form. A faster inner loop is approximated by 1:
// L(z) = b0 (d1 z + d0) / ((z + a0)(z - 1) z^m).
#pragma once
#include <optional>

#include "sixstep/design/loops/pole_placement.hpp"

namespace sixstep::design {

struct Margins {
  double crossover_rad_s = 0.0;  ///< frequency at which |L| = 1
  double phase_rad = 0.0;        ///< phase distance to -180 degrees at the crossover
  std::optional<double> gain;    ///< factor on the gain at which the loop becomes unstable; empty: no factor
                                 ///< above 1
  double delay_s = 0.0;          ///< additional dead time at which the phase margin is 0
};

/// `delayed` sets m: 1 if an output acts one period after its sample, else 0. The result is empty if |L|
/// never crosses 1: the gains are zero, or too high for the sampling.
std::optional<Margins> margins(const ZohPlant& plant, const PiGains& gains, double period_s, bool delayed);

}  // namespace sixstep::design

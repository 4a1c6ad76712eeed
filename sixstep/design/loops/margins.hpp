// SPDX-License-Identifier: Apache-2.0
// How far a loop, taken alone (inside it a faster loop counts as 1), is from instability: margins of L(z) =
// b0 (d1 z + d0) / ((z + a0)(z - 1) z^m), in closed form.
#pragma once
#include <optional>

#include "sixstep/design/loops/pole_placement.hpp"

namespace sixstep::design {

struct Margins {
  double crossover_rad_s = 0.0;  ///< where |L| = 1
  double phase_rad = 0.0;        ///< what is left to -180 degrees there
  std::optional<double> gain;  ///< factor on the loop's gain that makes it unstable; empty: none above 1 does
  double delay_s = 0.0;        ///< extra dead time that uses up the phase margin
};

/// m = 1 where a command takes effect one period after its sample, else 0. Empty where |L| never crosses 1:
/// the gains are zero, or the loop asks for more than its sampling can follow.
std::optional<Margins> margins(const ZohPlant& plant, const PiGains& gains, double period_s, bool delayed);

}  // namespace sixstep::design

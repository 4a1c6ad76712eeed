// SPDX-License-Identifier: Apache-2.0
// Checks whether an encoder or a resolver shows values that are impossible with an intact sensor.
#pragma once
#include <cmath>
#include <cstdint>

namespace sixstep::rig {

/// Kind of a sensor's fault, as far as the signals determine it.
enum class ShaftLoss : std::uint8_t {
  none,
  excitation,  ///< no signal from either winding of a resolver
  cosine,      ///< no signal from the cosine winding, but from the sine winding
  sine,
  weak,    ///< both signals are weaker than the excitation's tolerance allows
  strong,  ///< both signals are stronger than the excitation's tolerance allows
  index    ///< at an encoder's index the count has an error of more than a sector
};

struct ShaftFinding {
  ShaftLoss loss = ShaftLoss::none;
  double shown = 0.0;       ///< resolver: sqrt(c^2 + s^2) relative to the expected amplitude
  std::int32_t counts = 0;  ///< encoder: counts that are missing at the index

  bool lost() const { return loss != ShaftLoss::none; }
};

/// Limits of a resolver's c^2 + s^2, relative to the expected amplitude (design/loops/resolver_watch.hpp).
struct ResolverWatch {
  double least_square = 0.0, greatest_square = 0.0;  ///< 0: not checked
  double silent = 0.0;                               ///< a smaller signal counts as noise and rounding only
  int in_a_row = 1;                                  ///< number of consecutive results outside the limits
                                                     ///< after which the sensor counts as lost

  bool outside(double square) const {
    return square < least_square || (greatest_square > 0 && square > greatest_square);
  }
  /// Kind of the fault, for signals c and s outside the limits.
  ShaftFinding finding(double c, double s) const {
    const double square = c * c + s * s;
    const bool no_c = std::fabs(c) <= silent, no_s = std::fabs(s) <= silent;
    const ShaftLoss loss = square >= least_square ? ShaftLoss::strong
                           : no_c && no_s         ? ShaftLoss::excitation
                           : no_c                 ? ShaftLoss::cosine
                           : no_s                 ? ShaftLoss::sine
                                                  : ShaftLoss::weak;
    return {.loss = loss, .shown = std::sqrt(square)};
  }
};

}  // namespace sixstep::rig

// SPDX-License-Identifier: Apache-2.0
// What a drive finds out about an encoder or a resolver that shows what a whole one cannot.
#pragma once
#include <cmath>
#include <cstdint>

namespace sixstep::rig {

/// What is wrong, as far as signals tell.
enum class ShaftLoss : std::uint8_t {
  none,
  excitation,  ///< neither winding of a resolver shows anything
  cosine,      ///< one winding shows nothing, the other one does
  sine,
  weak,    ///< both show less than full excitation leaves of them
  strong,  ///< or more
  index    ///< an encoder's index came where the count is further off than a sector
};

struct ShaftFinding {
  ShaftLoss loss = ShaftLoss::none;
  double shown = 0.0;       ///< of a resolver: sqrt(c^2 + s^2) as a part of what is expected
  std::int32_t counts = 0;  ///< of an encoder: missing, says the index

  bool lost() const { return loss != ShaftLoss::none; }
};

/// Limits of a resolver's c^2 + s^2, as parts of the amplitude expected (design/loops/resolver_watch.hpp).
struct ResolverWatch {
  double least_square = 0.0, greatest_square = 0.0;  ///< 0: not looked at
  double silent = 0.0;                               ///< a signal within it is nothing but noise and rounding
  int in_a_row = 1;                                  ///< results outside

  bool outside(double square) const {
    return square < least_square || (greatest_square > 0 && square > greatest_square);
  }
  /// Of signals that were outside.
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

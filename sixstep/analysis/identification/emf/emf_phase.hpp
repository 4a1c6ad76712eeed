// SPDX-License-Identifier: Apache-2.0
// How fast the motor turned: the phase of the fundamental over time, first by zero crossings, then by least squares.
#pragma once
#include <array>
#include <cstddef>
#include <vector>

#include "sixstep/analysis/identification/emf/emf_record.hpp"
#include "sixstep/base/result.hpp"

namespace sixstep::analysis {

/// phase(t) = sum of rate[k] tau^(k+1)/(k+1)!, tau from the recording's middle: a speed that is steady, or
/// changes as a line or a parabola. A drill slows down under a load, a motor let go coasts.
struct EmfPhase {
  static constexpr std::size_t most_terms = 3;
  double middle_s = 0.0;
  std::array<double, most_terms> rate{};  ///< rad/s, rad/s^2, rad/s^3
  std::size_t terms = 1;

  double at(double t_s) const;     ///< rad
  double speed(double t_s) const;  ///< rad/s
};

/// How many terms so many periods fix.
std::size_t phase_terms(double periods);

/// Of the channel with the greatest voltage. Or why there is no period to be seen.
base::Result<EmfPhase> rough_phase(const EmfRecord& record);

}  // namespace sixstep::analysis

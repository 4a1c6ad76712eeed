// SPDX-License-Identifier: Apache-2.0
// Finds the motor's speed: the phase of the fundamental over time, first by zero crossings, then by least
// squares.
#pragma once
#include <array>
#include <cstddef>
#include <vector>

#include "sixstep/analysis/identification/emf/emf_record.hpp"
#include "sixstep/base/result.hpp"

namespace sixstep::analysis {

/// phase(t) = sum of rate[k] tau^(k+1)/(k+1)!, with tau counted from the recording's middle. The speed is
/// constant, linear or a parabola in time: a drill slows down under a load, and a free motor coasts.
struct EmfPhase {
  static constexpr std::size_t most_terms = 3;
  double middle_s = 0.0;
  std::array<double, most_terms> rate{};  ///< rad/s, rad/s^2, rad/s^3
  std::size_t terms = 1;

  double at(double t_s) const;     ///< rad
  double speed(double t_s) const;  ///< rad/s
};

/// Number of terms that can be determined from this number of periods.
std::size_t phase_terms(double periods);

/// The phase of the channel with the greatest voltage, or a Problem with the reason why no period is visible.
base::Result<EmfPhase> rough_phase(const EmfRecord& record);

}  // namespace sixstep::analysis

// SPDX-License-Identifier: Apache-2.0
// A loop as it was measured, from the closed one's answer: L = T/(1 - T), and the margins read off its points.
#pragma once
#include <optional>
#include <vector>

#include "sixstep/analysis/bode/multisine.hpp"

namespace sixstep::analysis {

struct LoopPoint {
  double w_rad_s = 0.0;
  design::Complex closed;  ///< T, reference to what is controlled
  double coherence = 0.0;
  double gain = 0.0, phase_rad = 0.0;  ///< of L, the phase unwrapped from the lowest line on
  double scatter = 0.0;                ///< standard deviation of |L| over |L|: that of |T| times |1 + L|
};

/// Of a multisine's answer, samples a period apart.
std::vector<LoopPoint> loop_points(const Multisine& signal, const Answer& answer, double period_s);

/// As design::LoopFigures has them; between two points |L| in dB and phase run straight over the logarithm of the frequency.
/// Empty where no point lies on the far side.
struct ReadMargins {
  std::optional<double> crossover_rad_s;  ///< the last frequency at which |L| falls through 1
  std::optional<double> phase_rad;        ///< what is left to -180 degrees there
  std::optional<double> gain;             ///< 1/|L| where the phase falls through -180 degrees
  std::optional<double> delay_s;          ///< phase over crossover
  std::optional<double> bandwidth_rad_s;  ///< where |T| falls below 1/sqrt 2
};
ReadMargins margins_of(const std::vector<LoopPoint>& points);

/// Below it half of what came at a line was not the multisine's.
inline constexpr double little_coherence = 0.9;
/// Whether any line at all came back. Of a loop that did not answer nothing is measured.
bool answered(const std::vector<LoopPoint>& points);

}  // namespace sixstep::analysis

// SPDX-License-Identifier: Apache-2.0
// A loop as it was measured, from the closed one's answer: L = T/(1 - T), and the margins read off its points.
#pragma once
#include <optional>
#include <vector>

#include "sixstep/analysis/bode/multisine.hpp"
#include "sixstep/design/loops/rotor_sensing.hpp"

namespace sixstep::analysis {

struct LoopPoint {
  double w_rad_s = 0.0;
  design::Complex closed;  ///< T, reference to what the controller is told
  double coherence = 0.0;
  double gain = 0.0, phase_rad = 0.0;  ///< of L, the phase of the turn that next_to() gives
  double scatter = 0.0;                ///< standard deviation of |L| over |L|: that of |T| times |1 + L|
};

/// A phase is known but for whole turns: the one of `angle` that lies within half a turn of `near`.
double next_to(double angle, double near);
/// Each by the shorter way from the one before; the first in (-360, 0] degrees, as a loop that integrates has it.
std::vector<double> unwrapped(const std::vector<double>& angles);

/// Of a multisine's answer, samples a period apart. `lag`: of the sensor between what was recorded and the controller. L = T/(1 - T)
/// holds of what goes round the loop, which is T times the lag; with the true speed in its place L would be read as 1/(lag - 1)
/// wherever T is near 1, and without any lag where it is small.
std::vector<LoopPoint> loop_points(const Multisine& signal, const Answer& answer, double period_s,
                                   const std::optional<design::SpeedLag>& lag = {});

/// As design::LoopFigures has them; between two points |L| in dB and phase run straight over the logarithm of the frequency.
/// Empty where no point lies on the far side.
struct ReadMargins {
  std::optional<double> crossover_rad_s;  ///< the last frequency at which |L| falls through 1
  std::optional<double> phase_rad;        ///< what is left to -180 degrees there, in (-180, 180] degrees
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

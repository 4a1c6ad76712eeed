// SPDX-License-Identifier: Apache-2.0
// Computes the open loop L = T/(1 - T) from the measured closed loop T, and the margins from the points of L.
#pragma once
#include <optional>
#include <vector>

#include "sixstep/analysis/bode/multisine.hpp"
#include "sixstep/design/loops/rotor_sensing.hpp"

namespace sixstep::analysis {

struct LoopPoint {
  double w_rad_s = 0.0;
  design::Complex closed;  ///< the closed loop T, from the reference to the measured value
  double coherence = 0.0;
  double gain = 0.0, phase_rad = 0.0;  ///< gain and phase of L; next_to() chooses the phase's turn
  double scatter = 0.0;  ///< relative deviation of |L|: |1 + L| times the relative deviation of |T|
};

/// The angle plus or minus whole turns, so that it lies within half a turn of `near`, rad.
double next_to(double angle, double near);
/// Adds whole turns so that each angle lies within half a turn of the angle before. The first angle lies in
/// (-360, 0] degrees, as for a loop with an integral.
std::vector<double> unwrapped(const std::vector<double>& angles);

/// The points of L from the response to a multisine with samples a period apart. The response was recorded
/// before the sensor, whose lag is `lag`. L = T/(1 - T) holds for the measured signal, which is T times the
/// lag. With the true speed instead, the result would be 1/(lag - 1) where T is near 1, and L without the lag
/// where T is small.
std::vector<LoopPoint> loop_points(const Multisine& signal, const Answer& answer, double period_s,
                                   const std::optional<design::SpeedLag>& lag = {});

/// The figures of design::LoopFigures, computed from points. Between two points, |L| in dB and the phase are
/// linear over the logarithm of the frequency. A figure is empty if no point lies beyond the figure's level.
struct ReadMargins {
  std::optional<double> crossover_rad_s;  ///< the last frequency at which |L| falls through 1
  std::optional<double> phase_rad;        ///< phase margin at crossover_rad_s, in (-180, 180] degrees
  std::optional<double> gain;             ///< gain margin, at the frequency where the phase first falls
                                          ///< through -180 degrees
  std::optional<double> delay_s;          ///< delay margin: phase margin divided by the crossover, at least 0
  std::optional<double> bandwidth_rad_s;  ///< the frequency at which |T| first falls below 1/sqrt 2
};
ReadMargins margins_of(const std::vector<LoopPoint>& points);

/// Least coherence of a line to which the loop responded. Below it, too much of the response has another
/// source than the multisine.
inline constexpr double little_coherence = 0.9;
/// True if the loop responded at any line; otherwise no margin is computed.
bool answered(const std::vector<LoopPoint>& points);

}  // namespace sixstep::analysis

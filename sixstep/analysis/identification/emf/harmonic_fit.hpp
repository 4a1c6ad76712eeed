// SPDX-License-Identifier: Apache-2.0
// A periodic voltage of a speed that nearly holds: frequency and harmonics by least squares, with the noise
// beside each harmonic.
//
//   u(t) = offset + w(t)/w_0 sum over h of (a_h cos h phase + b_h sin h phase)
//
// An induced voltage grows with the speed w. What is left over is no white noise, as a rule: a drill's wobble,
// a mains hum, an oscilloscope's steps. So each harmonic's interval is made of the residual's own spectrum
// beside that harmonic (D. R. Brillinger, "Time Series: Data Analysis and Theory", 1975, 5.4).
#pragma once
#include <cstddef>
#include <vector>

#include "sixstep/analysis/identification/emf/emf_phase.hpp"

namespace sixstep::analysis {

struct Harmonic {
  double a_V = 0.0, b_V = 0.0;
  double deviation_V = 0.0;  ///< of each
  double degrees_of_freedom = 0.0;
};

struct ChannelFit {
  double offset_V = 0.0;
  std::vector<Harmonic> harmonics;  ///< harmonics[0] is the fundamental
  double residual_rms_V = 0.0;
  double step_V = 0.0;          ///< the least that two rows differ by: the converter's
  double step_at_peak_V = 0.0;  ///< by how much the steps may falsify the peak, rms
  double explained = 0.0;       ///< part of the power about the mean
};

struct HarmonicFit {
  EmfPhase phase;
  double speed_deviation = 0.0;  ///< of the electrical speed at the middle, rad/s
  double degrees_of_freedom = 0.0;
  double periods = 0.0;
  std::vector<ChannelFit> channels;
};

/// The model at a time.
double fitted_V(const HarmonicFit& fit, std::size_t channel, double t_s);

inline constexpr std::size_t most_harmonics = 25;

/// From a phase that is right within half a radian. Without channels where the recording holds one period or less.
base::Result<HarmonicFit> fit_harmonics(const EmfRecord& record, const EmfPhase& rough);

}  // namespace sixstep::analysis

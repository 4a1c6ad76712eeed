// SPDX-License-Identifier: Apache-2.0
// Fits frequency and harmonics of a periodic voltage at nearly constant speed by least squares, and finds the
// noise near each harmonic.
//
//   u(t) = offset + w(t)/w_0 sum over h of (a_h cos h phase + b_h sin h phase)
//
// a_h, b_h: harmonic of order h; w_0: speed at the recording's middle. The factor w(t)/w_0 is needed because
// an induced voltage is proportional to the speed w. The residual is usually not white noise: a drill
// wobbles, the mains cause hum, an oscilloscope has steps. Each harmonic's interval therefore follows from
// the residual's spectrum near the harmonic (D. R. Brillinger, "Time Series: Data Analysis and Theory", 1975,
// 5.4).
#pragma once
#include <cstddef>
#include <vector>

#include "sixstep/analysis/identification/emf/emf_phase.hpp"

namespace sixstep::analysis {

struct Harmonic {
  double a_V = 0.0, b_V = 0.0;
  double deviation_V = 0.0;  ///< standard deviation of a_V and of b_V
  double degrees_of_freedom = 0.0;
};

struct ChannelFit {
  double offset_V = 0.0;
  std::vector<Harmonic> harmonics;  ///< harmonics[0] is the fundamental
  double residual_rms_V = 0.0;
  double step_V = 0.0;          ///< smallest difference of two successive rows: the converter's step
  double step_at_peak_V = 0.0;  ///< rms error of the peak caused by the steps
  double explained = 0.0;       ///< fraction of the power about the mean that the fit explains
};

struct HarmonicFit {
  EmfPhase phase;
  double speed_deviation =
      0.0;  ///< standard deviation of the electrical speed at the recording's middle, rad/s
  double degrees_of_freedom = 0.0;
  double periods = 0.0;
  std::vector<ChannelFit> channels;
};

/// The fitted voltage at a time.
double fitted_V(const HarmonicFit& fit, std::size_t channel, double t_s);

inline constexpr std::size_t most_harmonics = 25;

/// Fits a recording from a `rough` phase with an error below half a radian. Returns no channels if the
/// recording has one period or less.
base::Result<HarmonicFit> fit_harmonics(const EmfRecord& record, const EmfPhase& rough);

}  // namespace sixstep::analysis

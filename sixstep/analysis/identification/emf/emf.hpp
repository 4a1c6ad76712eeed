// SPDX-License-Identifier: Apache-2.0
// Measures a motor's constants in every frame, its harmonics and its back-EMF shape from open-circuit
// voltages.
//
// A constant per electrical rad/s is the flux linkage of phase or line. If the pole pairs or the shaft's
// speed are known, the constants per mechanical rad/s are also computed, like K_e in notation.md.
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "sixstep/analysis/identification/emf/harmonic_fit.hpp"
#include "sixstep/analysis/identification/interval.hpp"
#include "sixstep/base/result.hpp"

namespace sixstep::analysis {

struct EmfRequest {
  EmfRecord record;
  std::optional<int> pole_pairs;
  std::optional<double> speed_rad_s;  ///< speed of the shaft; the pole pairs follow from frequency and speed
};

struct EmfHarmonic {
  int order = 1;
  Interval part;       ///< amplitude relative to the fundamental
  double floor = 0.0;  ///< limit that noise exceeds at any order in 5 of 100 recordings
  bool stands_out = false;
  /// Coordinates of a harmonic of the phase's shape, relative to the fundamental: factors of the cosine and
  /// the sine of order times (theta_e - 60 deg).
  double in_phase = 0.0, across = 0.0;
};

struct EmfChannelResult {
  std::string name;
  double offset_V = 0.0;
  Interval peak_V;     ///< peak of the fundamental
  Interval phase_deg;  ///< lag behind the first channel
  double residual_rms_V = 0.0;
  double step_V = 0.0;   ///< smallest difference of two successive rows: the converter's step
  double clipped = 0.0;  ///< largest number of successive rows at the greatest or least value, as a fraction
                         ///< of a period
};

/// Constants in V s per electrical rad. Multiplied by the pole pairs, they are in V s per mechanical rad.
struct EmfConstants {
  Interval line_peak, line_rms, line_fundamental;
  /// Constants of a phase. If they are computed from voltages between lines, harmonics of order 3, 9, .. are
  /// missing.
  Interval phase_peak, phase_rms, phase_fundamental;
};

struct EmfResult {
  EmfBetween between = EmfBetween::lines;
  std::size_t rows = 0;
  double seconds = 0.0, periods = 0.0;
  Interval frequency_Hz;     ///< frequency at the recording's middle
  double change_Hz_s = 0.0;  ///< rate of change of the frequency, at the middle
  int pole_pairs = 0;        ///< 0: unknown
  std::vector<EmfChannelResult> channels;
  bool backward = false;               ///< true: the voltages follow each other as c, b, a
  bool all_phases = false;             ///< true: there are two or three channels, so that `backward` is known
  std::vector<EmfHarmonic> harmonics;  ///< harmonics from the second on
  EmfConstants constants;
  double crest = 0.0;     ///< peak of the probed voltage, divided by its rms
  double flat_deg = 0.0;  ///< width above 95 % of the peak
  /// Phase a over an electrical turn, with peak 1. The middle of its positive half wave is at 60 degrees
  /// (notation.md). Harmonics below the noise are not included.
  std::vector<double> angle_deg, shape;
  HarmonicFit fit;                 ///< the fit, for a picture
  double shape_sector_mean = 0.0;  ///< K_t/K_e of the fitted shape; the table agrees within 1e-4
};

/// flat_deg of a sine and of a trapezoid with a top of 120 degrees, for comparison.
inline constexpr double flat_of_sine_deg = 36.39, flat_of_trapezoid_deg = 123.0;

base::Result<EmfResult> measure_emf(const EmfRequest& request);

}  // namespace sixstep::analysis

// SPDX-License-Identifier: Apache-2.0
// Computes the errors of harmonics by a converter's steps.
#pragma once
#include <vector>

namespace sixstep::analysis {

/// A voltage to be converted: offset, a_1, b_1, a_2 and so on over its phase, the converter's step, and the
/// noise of a single value, rms.
struct Converted {
  std::vector<double> unknowns;
  double step_V = 0.0, noise_V = 0.0;
};

struct StepErrors {
  std::vector<double> harmonics_V;  ///< errors of each a or b
  double peak_V = 0.0;              ///< error of the sum of the harmonics at its peak
};

/// Error of each harmonic by the steps, rms over all positions of the steps. The spectrum near a harmonic
/// does not contain this error, because the error repeats with the period. Flat tops have the largest error,
/// because a whole top may lie on one step. With noise of deviation s, the mean reading of a value u is u
/// plus the following sum, all in steps (B. Widrow, I. Kollar, "Quantization Noise", 2008, 4):
///   sum over n of (-1)^n/(pi n) exp(-2 pi^2 n^2 s^2) sin(2 pi n u)
StepErrors step_errors(const Converted& converted);

}  // namespace sixstep::analysis

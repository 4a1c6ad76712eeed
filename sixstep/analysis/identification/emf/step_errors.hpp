// SPDX-License-Identifier: Apache-2.0
// What a converter's steps do to harmonics.
#pragma once
#include <vector>

namespace sixstep::analysis {

/// Offset, a_1, b_1, a_2 and so on of a voltage over its phase, the converter's step, and how much noise spreads each value
/// over its steps.
struct Converted {
  std::vector<double> unknowns;
  double step_V = 0.0, noise_V = 0.0;
};

struct StepErrors {
  std::vector<double> harmonics_V;  ///< of a or b
  double peak_V = 0.0;              ///< of the sum of the harmonics, where it is greatest
};

/// By how much the steps falsify each harmonic, rms over all places that the steps may have. No spectrum beside
/// a harmonic shows it, for it repeats with the period; flat tops, which may all lie on one step, suffer most.
/// Averaged over the noise s, in steps, a value u reads as u plus the sum over n of (-1)^n/(pi n) exp(-2 pi^2
/// n^2 s^2) sin(2 pi n u), in steps (B. Widrow, I. Kollar, "Quantization Noise", 2008, 4).
StepErrors step_errors(const Converted& converted);

}  // namespace sixstep::analysis

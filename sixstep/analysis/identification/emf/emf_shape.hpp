// SPDX-License-Identifier: Apache-2.0
// Describes a back-EMF shape by its harmonics, and converts it between the probed voltage, phase and line.
#pragma once
#include <cstddef>
#include <vector>

#include "sixstep/analysis/identification/emf/emf_record.hpp"

namespace sixstep::analysis {

/// Sum over h of re cos(h x) - im sin(h x), that is of the real part of (re + j im) exp(j h x). The fundamental
/// is 1, its peak at x = 0.
struct ShapeHarmonics {
  std::vector<double> re{1.0}, im{0.0};  ///< [0] is the fundamental

  std::size_t size() const { return re.size(); }
  void resize(std::size_t count) {
    re.resize(count);
    im.resize(count);
  }
  double at(double x_rad) const;
  double rms() const;
};

/// The shape over the angle, from the shape over time of a rotor that turned backwards.
ShapeHarmonics seen_backward(ShapeHarmonics seen);

/// Convert the shape of a voltage between two terminals to that of a phase, and back. Both have a fundamental of
/// 1, which between lines is sqrt 3 of a phase's. Harmonics of order 3, 6, 9 are equal in all phases, so that
/// they cancel between lines.
ShapeHarmonics phase_of_line(const ShapeHarmonics& line);
ShapeHarmonics line_of_phase(const ShapeHarmonics& phase);

struct ShapePeak {
  double value = 0.0;  ///< greatest |shape|
  double x_rad = 0.0;
  double flat_deg = 0.0;  ///< width above 95 % of it
};
ShapePeak peak_of(const ShapeHarmonics& shape);

/// The peak of the wave of which these are the first harmonics. The harmonics of a flat top go on beyond these:
/// the sum without the rest overshoots by 1 to 5 % near the flanks (Gibbs). The sum averaged over a turn of
/// the first missing harmonic (Lanczos) leaves a tenth of that. A pointed top lacks the part of the missing
/// harmonics, and stays as summed. `below` and `above`: uncertainty of the peak.
struct WavePeak {
  ShapePeak peak;
  double below = 0.0, above = 0.0;
};
WavePeak wave_peak(const ShapeHarmonics& shape);

}  // namespace sixstep::analysis

// SPDX-License-Identifier: Apache-2.0
// Describes a back-EMF shape by its harmonics, and converts it between the probed voltage, phase and line.
#pragma once
#include <cstddef>
#include <vector>

#include "sixstep/analysis/identification/emf/emf_record.hpp"

namespace sixstep::analysis {

/// Sum over h of re cos(h x) - im sin(h x): the real part of the sum of (re + j im) exp(j h x). The
/// fundamental is 1, with its peak at x = 0.
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

/// Converts the shape over time, measured with a rotor that turned backwards, to the shape over the angle.
ShapeHarmonics seen_backward(ShapeHarmonics seen);

/// Convert the shape of a voltage between two terminals to the shape of a phase, and back. Both shapes have a
/// fundamental of 1; the line's fundamental is sqrt 3 times the phase's fundamental. Harmonics of order 3, 6,
/// 9 are equal in all phases, so that they cancel between lines.
ShapeHarmonics phase_of_line(const ShapeHarmonics& line);
ShapeHarmonics line_of_phase(const ShapeHarmonics& phase);

struct ShapePeak {
  double value = 0.0;  ///< greatest |shape|
  double x_rad = 0.0;
  double flat_deg = 0.0;  ///< width above 95 % of this value
};
ShapePeak peak_of(const ShapeHarmonics& shape);

/// The peak of the wave with the given first harmonics, and the peak's uncertainty in `below` and `above`.
///
/// A flat top has harmonics beyond the given harmonics. Without them the sum overshoots by 1 to 5 % near the
/// flanks (Gibbs). Averaging the sum over a turn of the first missing harmonic (Lanczos) reduces the
/// overshoot to a tenth. A pointed top is not averaged; its peak lacks the missing harmonics.
struct WavePeak {
  ShapePeak peak;
  double below = 0.0, above = 0.0;
};
WavePeak wave_peak(const ShapeHarmonics& shape);

}  // namespace sixstep::analysis

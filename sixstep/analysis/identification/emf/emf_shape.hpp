// SPDX-License-Identifier: Apache-2.0
// A shape by its harmonics: from what a probe saw to the phase and back to the lines.
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

/// Of a shape seen over time while the rotor turned backwards: what it is over the angle.
ShapeHarmonics seen_backward(ShapeHarmonics seen);

/// Of a voltage between two terminals the phase's, and the other way round; both with a fundamental of 1, which between lines
/// is sqrt 3 of a phase's. What is of order 3, 6, 9 is the same in all phases: between lines there is none of it.
ShapeHarmonics phase_of_line(const ShapeHarmonics& line);
ShapeHarmonics line_of_phase(const ShapeHarmonics& phase);

struct ShapePeak {
  double value = 0.0;  ///< the greatest size
  double x_rad = 0.0;
  double flat_deg = 0.0;  ///< how wide it is above 95 % of that
};
ShapePeak peak_of(const ShapeHarmonics& shape);

/// The peak of the wave whose first harmonics these are. A flat top's harmonics go on: their sum without the rest overshoots it by
/// 1 to 5 % beside the flanks (Gibbs). Averaged over a turn of the first one that is missing (Lanczos) the sum leaves a tenth of that. A
/// pointed top lacks what the missing ones would add, and stays as summed. `below` and `above` is what is not known of either.
struct WavePeak {
  ShapePeak peak;
  double below = 0.0, above = 0.0;
};
WavePeak wave_peak(const ShapeHarmonics& shape);

}  // namespace sixstep::analysis

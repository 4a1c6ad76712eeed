// SPDX-License-Identifier: Apache-2.0
// Reduces a recording to the number of points that its harmonics require.
#pragma once
#include <cstddef>
#include <vector>

#include "sixstep/analysis/identification/emf/emf_record.hpp"
#include "sixstep/base/elementary.hpp"

namespace sixstep::analysis {

/// Points of a recording. Each point is the mean of several rows if there are far more rows than the
/// harmonics need.
struct HarmonicPoints {
  std::vector<double> t_s;
  std::vector<std::vector<double>> u_V;  ///< voltages of each channel
  double averaged_s = 0.0;               ///< time between two rows
  std::size_t averaged = 1;              ///< rows per point
};

HarmonicPoints harmonic_points(const EmfRecord& record, double periods);

/// Factor by which averaging multiplies a sine's amplitude.
double left_by_averaging(const HarmonicPoints& points, double rad_s);

/// cos and sin of phase, 2 phase, 3 phase ..
class Turning {
 public:
  explicit Turning(std::size_t harmonics) : cos_(harmonics), sin_(harmonics) {}
  void at(double phase) {
    const base::SinCos one = base::sin_cos(phase);
    double c = 1.0, s = 0.0;
    for (std::size_t h = 0; h < cos_.size(); ++h) {
      const double next = c * one.cos - s * one.sin;
      s = s * one.cos + c * one.sin;
      c = next;
      cos_[h] = c;
      sin_[h] = s;
    }
  }
  double cos(std::size_t h) const { return cos_[h]; }
  double sin(std::size_t h) const { return sin_[h]; }

 private:
  std::vector<double> cos_, sin_;
};

}  // namespace sixstep::analysis

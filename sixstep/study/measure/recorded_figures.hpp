// SPDX-License-Identifier: Apache-2.0
// Figures that one function computes from a recording and from the simulated signal, each with its
// uncertainty: twice the sampling of an edge, and the spread over pulses or over periods.
#pragma once
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

#include "sixstep/study/scenario/recording.hpp"

namespace sixstep::study {

/// Root of the sum of the squares, as uncertainties of independent causes add. std::hypot() differs between platforms.
inline double root_of_squares(double a, double b) { return std::sqrt(a * a + b * b); }

/// A signal at evenly spaced instants.
struct Samples {
  double start_s = 0.0, interval_s = 0.0;
  std::vector<double> values;

  double length_s() const { return interval_s * static_cast<double>(values.size()); }
};

/// Mean over `mean_s` around each instant; both ends become shorter by half of it.
void take_moving_mean(Samples& samples, double mean_s);

struct Estimate {
  double value = std::numeric_limits<double>::quiet_NaN();
  double uncertainty = 0.0;  ///< half width of the 95 % interval; infinite if a single pulse or period exists
  std::size_t count = 0;     ///< pulses, or whole periods
};

struct FigureAsked {
  NamedFigure figure;
  double period_s = 0.0;  ///< of the fundamental
  double level = 0.0, shortest_s = 0.0, longest_s = std::numeric_limits<double>::infinity();
};

/// The figure; NaN if there is no pulse or no whole period.
Estimate estimate(const FigureAsked& asked, const Samples& samples);

}  // namespace sixstep::study

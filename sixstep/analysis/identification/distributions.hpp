// SPDX-License-Identifier: Apache-2.0
// Normal, Student's and Rice's distributions for intervals, with the same bits on every platform.
#pragma once
#include <span>

#include "sixstep/analysis/identification/interval.hpp"

namespace sixstep::analysis {

/// Distribution function of the normal distribution with mean 0 and deviation 1; error below 1e-14.
double normal_cdf(double x);

/// Half width of Student's central 95 % interval, in standard deviations: 3.18 for 3 degrees of freedom, 1.96
/// for a large number. Fewer than 3 count as 3. The function uses the expansion of Abramowitz and Stegun
/// 26.7.5; its error is within 1 % at 3 degrees of freedom, and within 1e-4 from 6 on.
double student_95(double degrees_of_freedom);

/// One of several normal distributions of a mixture.
struct Component {
  double weight = 0.0, mean = 0.0, deviation = 0.0;
};

/// Mean of the mixture and its central 95 %. The weights sum to 1. A component with deviation 0 is a single
/// value.
Interval mixture_95(std::span<const Component> mixture);

/// Interval of a plane vector's true length, from the measured length and the standard deviation of each
/// coordinate. A vector of pure noise has a length too; its interval extends to 0. Each bound excludes 2.5 %
/// (Rice's distribution inverted). The interval contains a true length of 0 in at least 95 % of cases.
Interval length_95(double length, double deviation);

/// Like length_95() above, but with Student's width, for a standard deviation that was estimated.
Interval length_95(double length, double deviation, double degrees_of_freedom);

}  // namespace sixstep::analysis

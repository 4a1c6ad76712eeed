// SPDX-License-Identifier: Apache-2.0
// The distributions that intervals are made of, with the same bits on every platform.
#pragma once
#include <span>

#include "sixstep/analysis/identification/interval.hpp"

namespace sixstep::analysis {

/// Of the normal distribution with mean 0 and deviation 1; error below 1e-14.
double normal_cdf(double x);

/// Half the width of Student's central 95 % interval with that many degrees of freedom, at least 3 (fewer
/// count as 3): 3.18 for 3, 1.96 for many. By the expansion of Abramowitz and Stegun 26.7.5; within 1 % at 3,
/// 1e-4 from 6 on.
double student_95(double degrees_of_freedom);

/// One of several normal distributions that a number may come from.
struct Component {
  double weight = 0.0, mean = 0.0, deviation = 0.0;
};

/// Mean of the mixture and its central 95 %. The weights sum to 1; a deviation of 0 is a certain value.
Interval mixture_95(std::span<const Component> mixture);

/// The length of a vector in the plane of which each coordinate is read with that deviation: what the length
/// read says of the true one. A vector that is all noise has a length too; its interval reaches down to 0.
/// Both bounds leave 2.5 % (Rice's distribution inverted), so that a length of 0 is held at least as often.
Interval length_95(double length, double deviation);

/// With Student's width for a deviation that was estimated.
Interval length_95(double length, double deviation, double degrees_of_freedom);

}  // namespace sixstep::analysis

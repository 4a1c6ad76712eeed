// SPDX-License-Identifier: Apache-2.0
// Computes the model by which control/field/finite_set.hpp predicts a current, and the band within which the
// current stays. In a period T the bus voltage U changes the current by 2/3 b U in one of six directions, or
// not at all. The seven end points are corners of equilateral triangles with this side. The distance from any
// point within the hexagon of these points to the nearest end point is at most the triangles' circumradius,
//
//   2/(3 sqrt 3) b U,   b = (1 - exp(-R T/L))/R
#pragma once
#include <vector>

#include "sixstep/design/loops/field_current.hpp"

namespace sixstep::design {

struct FiniteSet {
  control::FiniteSetConfig<double> config;  ///< without weight of switching and without current limit
  double band_A = 0.0;  ///< largest distance from the reference to the predicted current, with the smaller L
  std::vector<DerivationStep> steps;
};

FiniteSet finite_set(const FieldMachine& machine, double period_s, double bus_V);

}  // namespace sixstep::design

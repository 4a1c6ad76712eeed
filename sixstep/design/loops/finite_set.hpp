// SPDX-License-Identifier: Apache-2.0
// The model that control/field/finite_set.hpp foretells a current by, and the band that its answers leave: in a period the bus U
// moves the current by b 2/3 U in one of six directions or not at all. The seven ends are corners of equilateral triangles of that
// side, so that within their hexagon nothing is further from one than their radius,
//
//   2/(3 sqrt 3) b U,   b = (1 - exp(-R T/L))/R
#pragma once
#include <vector>

#include "sixstep/design/loops/field_current.hpp"

namespace sixstep::design {

struct FiniteSet {
  control::FiniteSetConfig<double> config;  ///< without weight and bound
  double band_A = 0.0;  ///< from the reference to the current foretold, at most; by the smaller L
  std::vector<DerivationStep> steps;
};

FiniteSet finite_set(const FieldMachine& machine, double period_s, double bus_V);

}  // namespace sixstep::design

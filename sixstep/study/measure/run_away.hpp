// SPDX-License-Identifier: Apache-2.0
// has_run_away() returns whether the state has left all bounds of a motor. No single allowed value can cause
// this, but a combination can, such as a large torque on a small rotor. The simulation has no meaning
// afterwards.
#pragma once
#include <cmath>

#include "sixstep/plant/pace.hpp"
#include "sixstep/plant/plant.hpp"

namespace sixstep::study {

template <class Plant>
bool has_run_away(const Plant& plant) {
  using Real = typename Plant::Real;
  const plant::State<Real>& s = plant.state();
  const Real all = s.i[0] + s.i[1] + s.i[2] + s.w + s.x + s.bus;
  const bool numbers = all - all == 0;  // the difference is NaN, not 0, if one of the numbers is infinite or
                                        // NaN
  return !numbers || std::fabs(s.w) * plant.constants().pole_pairs > plant::fastest_field_rad_s;
}

}  // namespace sixstep::study

// SPDX-License-Identifier: Apache-2.0
#include "sixstep/plant/segment_energy.hpp"

namespace sixstep::plant {

SegmentEnergy<double> segment_energy(const Plant<double>& plant, double to) {
  return detail::segment_energy_here(plant, to);
}

}  // namespace sixstep::plant

// SPDX-License-Identifier: Apache-2.0
#include "sixstep/plant/audit.hpp"

namespace sixstep::plant {

template <>
void Audit<double>::segment(const Plant<double>& plant, double s) {
  take(plant, segment_energy(plant, s));
}

}  // namespace sixstep::plant

// SPDX-License-Identifier: Apache-2.0
// Voltage that the model assumes for the star point if no leg is connected (plant/circuit.hpp), also with
// broken wires.
#pragma once
#include <cstddef>

#include "sixstep/plant/circuit.hpp"

namespace sixstep::plant::general {

struct StarEnds {
  std::size_t high = 0, low = 0;
};

/// Legs with the highest and the lowest back-EMF. The star point's voltage (U_s - e_high - e_low)/2 centres
/// their terminals between the rails. A terminal with a broken wire (`dead`, a mask of legs) cannot conduct
/// to a rail and is ignored. If all wires are broken, no terminal is ignored.
template <class Real>
constexpr StarEnds star_ends(const PerLeg<Real>& e, unsigned dead) {
  if (dead == 0b111) dead = 0;
  StarEnds ends;
  while ((dead >> ends.high & 1) != 0) ++ends.high;
  ends.low = ends.high;
  for (std::size_t k = ends.high + 1; k < 3; ++k) {
    if ((dead >> k & 1) != 0) continue;
    if (e[k] > e[ends.high]) ends.high = k;
    // mutant: e[k] < e[ends.low] => e[k] > e[ends.low]
    if (e[k] < e[ends.low]) ends.low = k;
  }
  return ends;
}

}  // namespace sixstep::plant::general

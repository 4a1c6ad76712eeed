// SPDX-License-Identifier: Apache-2.0
#include "sixstep/plant/general/plant.hpp"
#include "sixstep/plant/plant.hpp"

namespace sixstep::plant {

template Snapshot<double> Plant<double>::at(double) const;
template Snapshot<double> general::Plant<double>::at(double) const;

}  // namespace sixstep::plant

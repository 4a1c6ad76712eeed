// SPDX-License-Identifier: Apache-2.0
#include "sixstep/plant/general/plant_heat.hpp"

namespace sixstep::plant::general {

template StretchLosses Plant<double>::losses_up_to(double) const;

}  // namespace sixstep::plant::general

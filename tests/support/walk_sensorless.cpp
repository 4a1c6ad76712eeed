// SPDX-License-Identifier: Apache-2.0
#include "tests/support/walk_rig.hpp"

namespace sixstep::testing {

Walk walk_sensorless(const study::Scenario& s, const study::Compiled& c, const WalkPlan& plan) {
  return detail::walk_chosen<rig::SensorlessDrive>(s, c, plan);
}

}  // namespace sixstep::testing

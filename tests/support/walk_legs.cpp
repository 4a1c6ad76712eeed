// SPDX-License-Identifier: Apache-2.0
#include "sixstep/study/live/chips.hpp"
#include "tests/support/walk_rig.hpp"

namespace sixstep::testing {

Walk walk_legs(const study::Scenario& s, const study::Compiled& c, const WalkPlan& plan) {
  return detail::walk_with(study::detail::field_chip(s, c), c, plan);
}

}  // namespace sixstep::testing

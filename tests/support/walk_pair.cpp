// SPDX-License-Identifier: Apache-2.0
#include "sixstep/study/live/chips.hpp"
#include "tests/support/walk_rig.hpp"

namespace sixstep::testing {

Walk walk_pair(const study::Scenario& s, const study::Compiled& c, const WalkPlan& plan) {
  using namespace study::detail;
  switch (s.control.drive) {
    case study::FirmwareKind::product:
      return detail::walk_with(product_chip(s, c), c, plan);
    case study::FirmwareKind::sensorless:
      return detail::walk_with(sensorless_chip(s, c), c, plan);
    default:
      return detail::walk_with(sensed_chip(s, c), c, plan);
  }
}

}  // namespace sixstep::testing

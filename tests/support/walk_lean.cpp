// SPDX-License-Identifier: Apache-2.0
#include "tests/support/walk_rig.hpp"

namespace sixstep::testing {

Walk walk(const study::Scenario& s, const study::Compiled& c, const WalkPlan& plan) {
  const bool product = s.control.drive == study::FirmwareKind::product;
  if (s.control.drive == study::FirmwareKind::sensorless)
    return c.general ? walk_sensorless_on_general(s, c, plan) : walk_sensorless(s, c, plan);
  if (s.control.drive == study::FirmwareKind::field) return walk_field(s, c, plan);
  if (c.general) return product ? walk_product_on_general(s, c, plan) : walk_sensed_on_general(s, c, plan);
  if (product) return walk_product(s, c, plan);
  return c.board.sensors.ideal() ? walk_lean(s, c, plan) : walk_sensed(s, c, plan);
}

Walk walk_lean(const study::Scenario& s, const study::Compiled& c, const WalkPlan& plan) {
  return detail::walk_chosen<rig::LeanDrive>(s, c, plan);
}

}  // namespace sixstep::testing

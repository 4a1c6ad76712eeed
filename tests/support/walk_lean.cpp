// SPDX-License-Identifier: Apache-2.0
#include "sixstep/study/compile/chip.hpp"
#include "tests/support/walk_rig.hpp"

namespace sixstep::testing {

Walk walk(const study::Scenario& s, const study::Compiled& c, const WalkPlan& plan) {
  using enum study::FirmwareKind;
  if (s.control.drive == field) return walk_legs(s, c, plan);
  const bool alone = s.control.drive == lean && c.board.sensors.ideal() && !c.general;
  return alone && s.control.arithmetic == study::Arithmetic::float64 ? walk_lean(s, c, plan)
                                                                     : walk_pair(s, c, plan);
}

Walk walk_lean(const study::Scenario& s, const study::Compiled& c, const WalkPlan& plan) {
  using Lean = rig::LeanDrive<double>;
  const auto chip = study::chip_of<Lean>(s, c);
  if (!chip) return {.problems = chip.problems()};
  return detail::walk_rig(study::rig_of<Lean>(c, *chip, c.timeline), c.end, plan);
}

}  // namespace sixstep::testing

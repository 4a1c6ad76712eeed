// SPDX-License-Identifier: Apache-2.0
#include "sixstep/study/run/on_core.hpp"

#include <algorithm>
#include <string>

#include "sixstep/base/describe.hpp"
#include "sixstep/study/scenario/changes.hpp"
#include "sixstep/study/scenario/choices.hpp"

namespace sixstep::study {

base::Problems not_on_a_core(const Scenario& s) {
  base::Problems out;
  if (s.control.drive == FirmwareKind::own)
    out.push_back({"control.drive", "\"own\"",
                   "does not run on a core: only the library's drives run on a core",
                   "count its instructions with tools/own_cost.sh, or set another control.drive"});
  if (s.control.mode == control::Mode::off)
    out.push_back(
        {"control.mode", "\"off\"", "runs no controller that a core could execute", "set control.mode"});
  if (std::any_of(s.at.begin(), s.at.end(), retunes))
    out.push_back({"at.control", "", "changes settings of the chip that are fixed in the core's program",
                   "remove such [[at]] events, or run the scenario without a core"});
  return out;
}

}  // namespace sixstep::study

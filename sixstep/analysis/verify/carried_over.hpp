// SPDX-License-Identifier: Apache-2.0
// What a board's scenario says of its drive beside the loops that were designed for it.
#pragma once
#include <string>

#include "sixstep/analysis/verify/design_study.hpp"

namespace sixstep::analysis {

struct CarriedOver {
  study::Scenario scenario;
  std::string kept;     ///< names of what the scenario has of the board's; empty where it has none
  std::string lost;     ///< why it has none, where the board says something
  std::string differs;  ///< figures that a run with them has, where the design without them has others
};

/// Puts the board's product drive, protection, limits, regeneration, full scale and what its loops have beside gains into a study's
/// scenario, and runs that. Where it does not pass, settles by a quarter later, or the drive is sensorless, which the design's is not,
/// the scenario stays as it was designed and says so in not_usable: no header is made of a drive that has lost its protection.
CarriedOver carry_over(const DesignStudy& study, study::Scenario designed, const study::Scenario& board);

/// Keys of the board's scenario that are neither the design's to choose nor in the scenario that it wrote: "control.slew, heat.motor".
/// Empty: there are none.
std::string left_out(study::Scenario board, study::Scenario written);

}  // namespace sixstep::analysis

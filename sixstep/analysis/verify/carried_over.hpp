// SPDX-License-Identifier: Apache-2.0
// What a board's scenario says of its drive beside the loops that were designed for it.
#pragma once
#include <string>

#include "sixstep/study/scenario/scenario.hpp"

namespace sixstep::analysis {

struct CarriedOver {
  study::Scenario scenario;
  std::string kept;  ///< names of what the scenario has of the board's; empty where it has none
};

/// Puts the board's product drive, protection, limits, regeneration and full scale into a designed scenario, and runs that. Where it
/// does not pass, or the drive is sensorless, which the design's is not, the scenario stays as it was designed and says
/// so in not_usable: no header is made of a drive that has lost its protection.
CarriedOver carry_over(study::Scenario designed, const study::Scenario& board);

}  // namespace sixstep::analysis

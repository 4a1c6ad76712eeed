// SPDX-License-Identifier: Apache-2.0
// Takes over from a board's scenario the settings of its drive beside the designed loops.
#pragma once
#include <string>

#include "sixstep/analysis/verify/design_study.hpp"

namespace sixstep::analysis {

struct CarriedOver {
  study::Scenario scenario;
  std::string kept;     ///< names of what was taken over; empty: nothing
  std::string lost;     ///< why nothing was taken over, where the board has something
  std::string differs;  ///< figures that the run with them changes
};

/// Puts the board's product drive, protection, limits, regeneration, full scale and its loops' settings beside
/// gains into a study's scenario, and runs that. The scenario stays as designed, with the reason in not_usable,
/// where the run does not pass or settles later by a quarter, or where the drive is sensorless, which the design's
/// is not. A drive that has lost its protection must not become a header.
CarriedOver carry_over(const DesignStudy& study, study::Scenario designed, const study::Scenario& board);

/// Keys of the board's scenario that the design does not choose and that the written scenario does not have:
/// "control.slew, heat.motor". Empty: there are none.
std::string left_out(study::Scenario board, study::Scenario written);

/// The board's course and judgement that the design's own test replaces in the written scenario: "reference (at
/// most 300, now 105 rad/s), require (greatest current)". Empty: nothing.
std::string replaced(const study::Scenario& board, const study::Scenario& written);

}  // namespace sixstep::analysis

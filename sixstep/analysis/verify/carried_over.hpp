// SPDX-License-Identifier: Apache-2.0
// Copies from a board's scenario the settings of its drive that the design does not choose.
#pragma once
#include <string>

#include "sixstep/analysis/verify/design_study.hpp"

namespace sixstep::analysis {

struct CarriedOver {
  study::Scenario scenario;
  std::string kept;     ///< names of the copied settings; empty: none
  std::string lost;     ///< reason why nothing was copied, although the board has settings
  std::string differs;  ///< figures that change with these settings
};

/// Copies settings of the board into a study's scenario, and runs it: product drive, protection, limits,
/// regeneration, full scale and settings of loops except gains. A drive without its protection must not
/// become a header. Therefore the scenario stays as designed, with the reason in not_usable, in three cases:
/// - the run does not pass;
/// - the run's settling time is longer by a quarter;
/// - the board's drive is sensorless, and the design's drive is not.
CarriedOver carry_over(const DesignStudy& study, study::Scenario designed, const study::Scenario& board);

/// Keys of the board's scenario that the design does not choose and that the written scenario does not have:
/// "control.slew, heat.motor". Empty: there are none.
std::string left_out(study::Scenario board, study::Scenario written);

/// The board's reference and requirements that the written scenario replaces by the design's own test:
/// "reference (at most 300, now 105 rad/s), require (greatest current)". Empty: nothing.
std::string replaced(const study::Scenario& board, const study::Scenario& written);

}  // namespace sixstep::analysis

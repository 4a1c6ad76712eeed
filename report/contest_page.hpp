// SPDX-License-Identifier: Apache-2.0
// Writes a comparison of controllers as one HTML file: the least value of each figure, torque ripple against
// losses, and each controller's response to the load step beside the response of the six-step controller.
#pragma once
#include <string>

#include "sixstep/analysis/contest/contest.hpp"

namespace report {

struct ContestPage {
  const sixstep::analysis::Contest& contest;
  std::string command;  ///< the command that writes this page again
  std::string version;
};

/// Returns the page. The same input gives the same bytes.
std::string render_contest(const ContestPage& page);

}  // namespace report

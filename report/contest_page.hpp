// SPDX-License-Identifier: Apache-2.0
// Controllers side by side as one HTML file: who has the least of what, torque ripple against losses, each one's answer to the
// load beside the usual one's.
#pragma once
#include <string>

#include "sixstep/analysis/contest/contest.hpp"

namespace report {

struct ContestPage {
  const sixstep::analysis::Contest& contest;
  std::string command;  ///< what makes this page again
  std::string version;
};

/// The same input gives the same bytes.
std::string render_contest(const ContestPage& page);

}  // namespace report

// SPDX-License-Identifier: Apache-2.0
// A design as one HTML file that opens anywhere, without a network and without a script.
#pragma once
#include <string>

#include "sixstep/analysis/verify/design_study.hpp"

namespace report {

struct DesignPage {
  const sixstep::analysis::DesignStudy& study;
  std::string verdict;   ///< one line
  std::string scenario;  ///< the file that was simulated
  std::string command;   ///< what makes this page again
  std::string version;
};

/// The same input gives the same bytes.
std::string render_design(const DesignPage& page);

}  // namespace report

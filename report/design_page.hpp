// SPDX-License-Identifier: Apache-2.0
// Writes a design as one HTML file that needs no network and no script.
#pragma once
#include <string>

#include "sixstep/analysis/verify/design_study.hpp"

namespace report {

struct DesignPage {
  const sixstep::analysis::DesignStudy& study;
  std::string verdict;   ///< verdict in one line
  std::string scenario;  ///< text of the simulated file
  std::string command;   ///< the command that writes this page again
  std::string version;
};

/// Returns the page. The same input gives the same bytes.
std::string render_design(const DesignPage& page);

}  // namespace report

// SPDX-License-Identifier: Apache-2.0
// Writes a loop's measured frequency response as one HTML file, drawn over the designed response.
#pragma once
#include <string>

#include "sixstep/analysis/bode/bode_study.hpp"

namespace report {

struct BodePage {
  std::string name;  ///< name of the scenario
  const sixstep::analysis::BodeStudy& study;
  std::string command;  ///< the command that writes this page again
  std::string version;
};

/// Returns the page. The same input gives the same bytes.
std::string render_bode(const BodePage& page);

}  // namespace report

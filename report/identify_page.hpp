// SPDX-License-Identifier: Apache-2.0
// Writes identified Hall probes as one HTML file: the angle of each edge, and the rotor's motion.
#pragma once
#include <string>

#include "sixstep/analysis/identification/hall/identify.hpp"

namespace report {

struct IdentifyPage {
  std::string name;  ///< name of the log
  const sixstep::analysis::HallIdentity& found;
  std::string command;  ///< the command that writes this page again
  std::string version;
};

/// Returns the page. The same input gives the same bytes.
std::string render_identify(const IdentifyPage& page);

}  // namespace report

// SPDX-License-Identifier: Apache-2.0
// The 36 ways to plug a motor in as one HTML file that opens anywhere, without a network and without a script.
#pragma once
#include <string>
#include <string_view>

#include "sixstep/analysis/wiring/wiring_study.hpp"

namespace report {

struct WiringPageInput {
  const sixstep::analysis::WiringStudy& study;
  std::string scenario;  ///< the run with straight wires, as the file that says it
  std::string_view command;
  std::string_view version;
};

/// The same input gives the same bytes.
std::string render_wiring(const WiringPageInput& input);

}  // namespace report

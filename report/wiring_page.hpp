// SPDX-License-Identifier: Apache-2.0
// Writes the 36 ways to connect a motor as one HTML file that needs no network and no script.
#pragma once
#include <string>
#include <string_view>

#include "sixstep/analysis/wiring/wiring_study.hpp"

namespace report {

struct WiringPageInput {
  const sixstep::analysis::WiringStudy& study;
  std::string scenario;  ///< scenario file of the run with straight wires
  std::string_view command;
  std::string_view version;
};

/// Returns the page. The same input gives the same bytes.
std::string render_wiring(const WiringPageInput& input);

}  // namespace report

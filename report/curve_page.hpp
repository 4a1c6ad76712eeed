// SPDX-License-Identifier: Apache-2.0
// Writes a torque-speed curve as one HTML file that needs no network.
#pragma once
#include <string>

#include "sixstep/analysis/curve/curve.hpp"

namespace report {

struct CurvePageInput {
  const sixstep::analysis::CurveRequest& request;
  const sixstep::analysis::Curve& curve;
  std::string command;  ///< the command that writes this page again
  std::string version;
};

/// Returns the page. The same input gives the same bytes.
std::string render_curve(const CurvePageInput& input);

}  // namespace report

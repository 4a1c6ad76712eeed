// SPDX-License-Identifier: Apache-2.0
// Writes a commissioning as one HTML file: the currents of its test, the rotor's motion, and all results.
#pragma once
#include <string>

#include "sixstep/analysis/commission/commission_study.hpp"

namespace report {

struct CommissionPage {
  const sixstep::analysis::CommissionStudy& study;
  std::string command;  ///< the command that makes this page again
  std::string version;
};

/// Returns the page. The same input gives the same bytes.
std::string render_commission(const CommissionPage& page);

}  // namespace report

// SPDX-License-Identifier: Apache-2.0
// Writes the results of a commissioning as one HTML file: the currents of the test, the rotor's motion, and
// all values.
#pragma once
#include <string>

#include "sixstep/analysis/commission/commission_study.hpp"

namespace report {

struct CommissionPage {
  const sixstep::analysis::CommissionStudy& study;
  std::string command;  ///< the command that writes this page again
  std::string version;
};

/// Returns the page. The same input gives the same bytes.
std::string render_commission(const CommissionPage& page);

}  // namespace report

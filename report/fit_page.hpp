// SPDX-License-Identifier: Apache-2.0
// Writes a fit as one HTML file: recorded and simulated values of each column, their difference, all figures.
#pragma once
#include <string>

#include "sixstep/analysis/identification/fit/fit_result.hpp"

namespace report {

struct FitPage {
  const sixstep::analysis::Fit& fit;
  const sixstep::design::Sheet& sheet;  ///< with the fitted values
  std::string command;                  ///< the command that writes this page again
  std::string version;
};

/// Returns the page. The same input gives the same bytes.
std::string render_fit(const FitPage& page);

}  // namespace report

// SPDX-License-Identifier: Apache-2.0
// Draws the parts of a plan's page that need no script: distributions of figures, and the influence of each key.
#pragma once
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "report/plan_page.hpp"
#include "report/plan_rows.hpp"
#include "sixstep/analysis/plan/sensitivity.hpp"

namespace report {

/// The histogram of one plan's runs.
struct DrawnHistogram {
  std::string_view colour;  ///< name of a colour in the style sheet
  const Histogram& histogram;
};

/// A <figure> with a bar for each bin: the bin's fraction of the plan's runs. Below: the span, limits close
/// to it, and the number of runs without a value.
std::string histogram_picture(const sixstep::analysis::FigureColumn& figure, const Span& span,
                              const std::vector<DrawnHistogram>& drawn);

/// Sobol indices of each figure as bars with their confidence intervals; empty if the plan is not sampled for
/// them.
std::string index_section(const PagePlan& plan);

}  // namespace report

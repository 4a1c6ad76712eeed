// SPDX-License-Identifier: Apache-2.0
// What needs no script of a plan's page: how figures are distributed, and which key each hangs on.
#pragma once
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "report/plan_page.hpp"
#include "report/plan_rows.hpp"
#include "sixstep/analysis/plan/sensitivity.hpp"

namespace report {

/// The runs of one plan in a histogram.
struct DrawnHistogram {
  std::string_view colour;  ///< of the style sheet
  const Histogram& histogram;
};

/// A <figure>: bars as high as their share of a plan's runs, from one end of the span to the other, the limits that lie near, and a line on what is no value.
std::string histogram_picture(const sixstep::analysis::FigureColumn& figure, const Span& span,
                              const std::vector<DrawnHistogram>& drawn);

/// Sobol indices of each figure as bars with their intervals; empty where the plan is not laid out for them.
std::string index_section(const PagePlan& plan);

}  // namespace report

// SPDX-License-Identifier: Apache-2.0
// Prints the result of the search for the best point in a plan's ranges.
#pragma once
#include <string>
#include <vector>

#include "sixstep/analysis/plan/optimum.hpp"
#include "sixstep/analysis/plan/plan_table.hpp"
#include "text/rooms.hpp"

namespace text {

struct OptimumStory {
  const std::string& name;
  const analysis::Plan& plan;
  const analysis::PlanColumns& columns;
  std::size_t figure = 0;  ///< index of the minimised figure's column
};

std::string optimum_text(const OptimumStory& story, const analysis::Optimum& best);
std::string optimum_json(const OptimumStory& story, const analysis::Optimum& best);

}  // namespace text

// SPDX-License-Identifier: Apache-2.0
// Finds the runs of a plan to inspect: for each requirement, the runs closest to its limit or beyond it; and
// the runs that stopped.
#pragma once
#include <cstddef>
#include <string>
#include <vector>

#include "report/plan_page.hpp"

namespace report {

struct NearRun {
  std::size_t number = 0;
  double value = 0.0;
  double room =
      0.0;  ///< distance to the nearer limit in the figure's unit; negative: beyond the limit; -infinity: no
            ///< value
};

inline constexpr std::size_t most_worst = 5;

/// One list per figure, with the worst run first; runs with equal values in the order of their numbers. The
/// list of a figure without a requirement is empty.
std::vector<std::vector<NearRun>> worst_of(const text::PlanStory& story, std::size_t most = most_worst);

/// Numbers of the runs to inspect first, without repetition: the worst run of each requirement, then the
/// first fault, then the second-worst runs and so on.
std::vector<std::size_t> worst_runs(const text::PlanStory& story, std::size_t most);

/// Tables of the worst runs, each with a link to its report or with the command that writes the report.
std::string worst_section(const PagePlan& plan);

}  // namespace report

// SPDX-License-Identifier: Apache-2.0
// The runs of a plan that are worth a look: per requirement those nearest to its limit or beyond it, and those that stopped.
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
      0.0;  ///< to the nearer limit, in the figure's unit; negative: beyond it; -infinity: it has no value
};

inline constexpr std::size_t most_worst = 5;

/// A list per figure, the worst first, of equal ones the first run; empty where nothing is required.
std::vector<std::vector<NearRun>> worst_of(const text::PlanStory& story, std::size_t most = most_worst);

/// Numbers of the runs to look at first, each once: the worst of each requirement, then the first fault, then the next ones.
std::vector<std::size_t> worst_runs(const text::PlanStory& story, std::size_t most);

/// Their tables, each run with the command that makes its report, or the link to it.
std::string worst_section(const PagePlan& plan);

}  // namespace report

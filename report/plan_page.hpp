// SPDX-License-Identifier: Apache-2.0
// Writes a plan's runs as one HTML file that needs no network: the spread of each figure, the influence of each
// key, the best trade-offs, the worst runs. Two plans share one page.
#pragma once
#include <cstddef>
#include <map>
#include <string>
#include <vector>

#include "text/results/plan_text.hpp"

namespace report {

struct PagePlan {
  const text::PlanStory& story;
  std::string title, motor, notes;
  std::string repeats;  ///< a command line that repeats a run once the run's number is appended: "sixstep run
                        ///< a.toml --only"
  std::map<std::size_t, std::string> reports{};  ///< file name of each existing report, by run number
};

struct PlanPageInput {
  std::vector<PagePlan> plans;  ///< one or two plans; the second is drawn over the first
  std::string command;
  std::string version;
};

inline constexpr std::size_t most_plans_on_a_page =
    2;  ///< each plan needs two colours: for passed and for failed runs

/// Largest number of rows in the drawings. If there are more runs, an even selection of them is drawn. The
/// statistics use all runs.
inline constexpr std::size_t most_rows_on_a_page = 200'000;

/// Returns the page. The same input gives the same bytes.
std::string render_plan(const PlanPageInput& input);

}  // namespace report

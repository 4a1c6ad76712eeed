// SPDX-License-Identifier: Apache-2.0
// A plan's runs as one HTML file that opens anywhere, without a network: how each figure strays, what hangs on what, the best
// trades, the worst runs. Of two plans one page with both.
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
  std::string repeats;  ///< a command line that a run's number completes: "sixstep run a.toml --only"
  std::map<std::size_t, std::string> reports{};  ///< runs that have a report beside the page, and its file
};

struct PlanPageInput {
  std::vector<PagePlan> plans;  ///< one or two; of two the second is drawn over the first
  std::string command;
  std::string version;
};

inline constexpr std::size_t most_plans_on_a_page =
    2;  ///< each has two colours, for what holds and what misses

/// So many rows can be drawn from; of more runs evenly many are left out of the drawings, never of the statistics.
inline constexpr std::size_t most_rows_on_a_page = 200'000;

/// The same input gives the same bytes.
std::string render_plan(const PlanPageInput& input);

}  // namespace report

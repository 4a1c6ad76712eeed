// SPDX-License-Identifier: Apache-2.0
// A plan's runs as text: for the terminal point by point, and as rows for programs.
#pragma once
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "sixstep/analysis/plan/sensitivity.hpp"
#include "sixstep/analysis/statistics/series.hpp"
#include "text/rooms.hpp"

namespace text {

/// A plan and what its runs came to; `each` visits their rows in the order of their numbers, with their points.
struct PlanStory {
  const std::string& name;
  const analysis::Plan& plan;
  const analysis::PlanColumns& columns;
  const analysis::Series& series;
  std::function<void(const std::function<void(const analysis::RunRecord&)>&)> each;
};

/// What a figure hangs on, an entry per key, of a plan laid out for it (Sampling::saltelli).
std::optional<std::vector<analysis::SensitivityIndex>> indices_of(const PlanStory& story, std::size_t figure);

/// Beyond these points a table says less than statistics do.
inline constexpr std::size_t most_points_shown = 60;

/// A line per point with its figures (of several drives the median, and how many hold), or the statistics of all runs; of a plan
/// for them the Sobol indices.
std::string plan_table(const PlanStory& story);

/// CSV: the head is a line of names with their units (plan_columns.hpp), then a line per run.
std::string plan_csv_head(const analysis::PlanColumns& columns);
std::string plan_csv_row(const analysis::RunRecord& record);

/// The whole table as JSON, with statistics and indices.
std::string plan_json(const PlanStory& story, const std::string& title, const std::string& motor);

}  // namespace text

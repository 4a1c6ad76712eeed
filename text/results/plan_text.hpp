// SPDX-License-Identifier: Apache-2.0
// Prints a plan's runs: point by point for the terminal, as CSV rows and as JSON.
#pragma once
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "sixstep/analysis/plan/sensitivity.hpp"
#include "sixstep/analysis/statistics/series.hpp"
#include "text/rooms.hpp"

namespace text {

/// A value that differs from drive to drive, with the width of its spread: "+-10 %", "normal, std. dev. 0.1
/// V".
struct DriveSpread {
  std::string key, width;
};

/// The spreads of the columns' keys.
std::vector<DriveSpread> drive_spreads(const study::Scenario& scenario, const analysis::PlanColumns& columns);
/// The text "each drive: KEY +-10 %, ..", and the tolerances that are not drawn, each with its reason. Empty
/// if the drives do not differ.
std::string drawn_text(const std::vector<DriveSpread>& spread, const std::string& not_drawn);

inline constexpr const char* too_few_points =
    "too few points for exact indices: an index is negative or above its total, or the first orders add up to more than 1; raise the number of points";

/// A plan and its results. `each` visits the rows, with their points, in the order of their numbers.
struct PlanStory {
  const std::string& name;
  const analysis::Plan& plan;
  const analysis::PlanColumns& columns;
  const analysis::Series& series;
  std::function<void(const std::function<void(const analysis::RunRecord&)>&)> each;
  std::vector<DriveSpread> spread = {};  ///< empty if the plan has no drives
  std::string not_drawn = {};            ///< tolerances that are not drawn, with reasons
};

/// The Sobol indices of a figure, one per key; empty unless the plan is sampled for them
/// (Sampling::saltelli).
std::optional<std::vector<analysis::SensitivityIndex>> indices_of(const PlanStory& story, std::size_t figure);

/// Up to this number of points the table is printed; for more, the statistics.
inline constexpr std::size_t most_points_shown = 60;

/// The table, in one of three forms:
/// - one line per point with its figures; for several drives the median, and the number of drives that meet
///   the requirements;
/// - the statistics of all runs;
/// - the Sobol indices, if the plan is sampled for them.
std::string plan_table(const PlanStory& story);

/// CSV: the head is a line of names with units (plan_columns.hpp), then one line per run.
std::string plan_csv_head(const analysis::PlanColumns& columns);
std::string plan_csv_row(const analysis::RunRecord& record);

/// The whole table as JSON, with statistics and indices.
std::string plan_json(const PlanStory& story, const std::string& title, const std::string& motor);

}  // namespace text

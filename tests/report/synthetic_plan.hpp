// SPDX-License-Identifier: Apache-2.0
// A plan with synthetic rows. It has many kinds of columns, values and ends, and any number of runs.
#pragma once
#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include "sixstep/base/random.hpp"
#include "text/results/plan_text.hpp"

namespace sixstep_tests {

struct SyntheticPlan {
  std::string name = "made-up";
  sixstep::analysis::Plan plan;
  sixstep::analysis::TableColumns columns;
  std::vector<sixstep::analysis::RunRecord> rows;
  sixstep::analysis::Series series;

  text::PlanStory story() const {
    return {name, plan, *columns, series, [this](const auto& visit) {
              for (const sixstep::analysis::RunRecord& row : rows) visit(row);
            }};
  }
  /// Replaces all names and keeps the values.
  void rename(sixstep::analysis::PlanColumns names, const std::string& problem) {
    columns = std::make_shared<const sixstep::analysis::PlanColumns>(std::move(names));
    for (sixstep::analysis::RunRecord& row : rows) {
      sixstep::analysis::RunValues values = *row;
      if (!values.problem.empty()) values.problem = problem;
      row = *sixstep::analysis::RunRecord::of(columns, std::move(values));
    }
    sum_up();
  }
  void sum_up() {
    series = sixstep::analysis::series_of(*columns);
    for (const sixstep::analysis::RunRecord& row : rows) sixstep::analysis::add(series, row);
  }
};

/// A plan over two numeric axes and optionally an axis of words. A shorter settling time needs a higher
/// current, and each word adds some current.
inline SyntheticPlan synthetic_plan(sixstep::analysis::Plan plan, double shift = 0.0) {
  using sixstep::analysis::RunEnd;
  SyntheticPlan made{.plan = std::move(plan)};
  constexpr const char* units[] = {"s", "V", ""};
  sixstep::analysis::PlanColumns columns;
  for (const auto& axis : made.plan.axes) columns.keys.push_back({axis.key, units[columns.keys.size()]});
  if (made.plan.drives > 0) columns.strayed = {{"motor_override.resistance_ohm", "ohm"}};
  columns.figures = {{"settling time of speed", "s", true, {}, 6e-3},
                     {"greatest current", "A", true, 2.0, 9.0},
                     {"ripple", "A", false, {}, {}}};
  made.columns = std::make_shared<const sixstep::analysis::PlanColumns>(std::move(columns));
  const std::size_t runs = runs_of(made.plan);
  for (std::size_t n = 0; n < runs; ++n) {
    sixstep::analysis::RunValues row;
    row.number = n;
    row.point = point_of_run(made.plan, n);
    std::uint64_t draws = 0;
    const auto noise = [&] { return sixstep::base::uniform({7, draws++, n}) - 0.5; };
    if (made.plan.drives > 0) row.strayed = {1.03 * (1 + 0.2 * noise())};
    const double wanted = std::stod(row.point[0]), supply = std::stod(row.point[1]);
    const double settle = wanted * (1 + 0.3 * noise()) + shift,
                 hard = row.point.size() > 2 && row.point[2] == "\"hard\"" ? 0.5 : 0.0;
    row.figures = {settle, 20e-3 / (settle + 1e-3) + 0.05 * supply + hard, 0.3 + 0.05 * supply * noise()};
    row.digest = n;
    if (n % 97 == 13) row.figures[0] = std::numeric_limits<double>::infinity();
    if (n % 89 == 7) row.end = RunEnd::fault, row.problem = "bridge: <b>shoot-through</b>";
    if (n % 83 == 5) {
      row.end = RunEnd::refused;
      row.problem = "no such drive";
      row.figures.assign(3, std::numeric_limits<double>::quiet_NaN());
    }
    made.rows.push_back(*sixstep::analysis::RunRecord::of(made.columns, std::move(row)));
  }
  made.sum_up();
  return made;
}

inline sixstep::analysis::Plan grid_plan() {
  using sixstep::analysis::Axis;
  return {.axes = {Axis{.key = "control.speed.settle_s", .from = 2e-3, .to = 8e-3, .points = 9},
                   Axis{.key = "supply.voltage_V", .from = 12, .to = 36, .points = 7},
                   Axis{.key = "pwm.chopping", .values = {"\"soft\"", "\"hard\""}}}};
}

inline sixstep::analysis::Plan drawn_plan(std::size_t points, sixstep::analysis::Sampling sampling) {
  using sixstep::analysis::Axis;
  return {.axes = {Axis{.key = "control.speed.settle_s",
                        .from = 2e-3,
                        .to = 8e-3,
                        .spacing = sixstep::analysis::Spacing::logarithmic},
                   Axis{.key = "supply.voltage_V", .from = 12, .to = 36}},
          .sampling = sampling,
          .points = points};
}

}  // namespace sixstep_tests

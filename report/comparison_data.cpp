// SPDX-License-Identifier: Apache-2.0
#include "report/comparison_data.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <deque>
#include <span>

#include "report/chart_json.hpp"
#include "report/plots.hpp"
#include "sixstep/design/sheet/motion.hpp"
#include "sixstep/study/measure/trace.hpp"

namespace report {
namespace {

using Values = std::vector<double>;

constexpr std::size_t difference_rows = 15000;  // few enough rows to be drawn without an envelope
                                                // (PlotSize::full)

struct Compared {
  const char *id, *title, *unit, *quantity, *column;
  double factor = 1.0;  ///< factor from the column's unit to the chart's unit
};
constexpr Compared of_turning_motors[] = {
    {"position", "Position", "°", "angle", "angle_rad", 180.0 / 3.14159265358979323846},
    {"speed", "Speed", "rad/s", "speed", "speed_rad_s"},
    {"motor-current", "Motor current", "A", "current", "i_m_A"},
    {"torque", "Torque", "Nm", "torque", "torque_Nm"},
    {"current-a", "Current of phase a", "A", "current", "i_a_A"},
    {"duty", "Duty", "", "", "duty"},
    {"bus", "Bus voltage", "V", "", "bus_V"},
};

constexpr Compared of_linear_motors[] = {
    {"position", "Position", "mm", "", "angle_rad", 1e3},
    {"speed", "Speed", "m/s", "", "speed_rad_s"},
    {"motor-current", "Motor current", "A", "current", "i_m_A"},
    {"force", "Force", "N", "", "torque_Nm"},
    {"current-a", "Current of phase a", "A", "current", "i_a_A"},
    {"duty", "Duty", "", "", "duty"},
    {"bus", "Bus voltage", "V", "", "bus_V"},
};

/// The compared quantities, in metres if all motors are linear.
std::span<const Compared> compared_of(const std::vector<ComparedRun>& runs) {
  const bool linear =
      std::ranges::all_of(runs, [](const ComparedRun& r) { return motion_of(r.scenario.sheet).linear; });
  if (linear) return of_linear_motors;
  return of_turning_motors;
}

/// A column in the unit of its chart; empty if the trace does not contain it.
Values column_of(const sixstep::study::Trace& trace, const Compared& what) {
  const auto* found = find_column(trace, what.column);
  Values out = found ? *found : Values();
  if (what.factor != 1.0)
    for (double& v : out) v *= what.factor;
  return out;
}

bool moves(const Values& values) {
  return std::ranges::any_of(values,
                             [&](double v) { return std::abs(v - values.front()) > 1e-9 * std::abs(v); });
}

/// Whether all runs contain the column, and its values change in at least one run.
bool worth_a_chart(const Compared& what, const std::vector<Values>& columns,
                   const std::vector<ComparedRun>& runs) {
  const bool has = std::ranges::none_of(columns, [](const Values& v) { return v.size() < 2; });
  const bool position = std::ranges::any_of(
      runs, [](const ComparedRun& r) { return r.scenario.control.mode == sixstep::control::Mode::position; });
  return has && (position || std::string_view(what.id) != "position") && std::ranges::any_of(columns, moves);
}

json overlay(const Compared& what, const std::vector<ComparedRun>& runs, const std::vector<Values>& columns,
             const std::vector<std::vector<Interval>>& keep, Axes& axes) {
  Group group{
      .id = what.id, .title = what.title, .unit = what.unit, .height_px = 200, .quantity = what.quantity};
  const PlotSize size;
  bool complete = true;
  std::size_t recorded = 0;
  json curves = json::array();
  for (std::size_t k = 0; k < runs.size(); ++k) {
    const auto& time = *find_column(runs[k].events, "t_s");
    const Thinned rows = thinned(time, {columns[k]}, keep[k], size.cap, size.full);
    complete = complete && rows.complete && runs[k].events.whole.empty();
    recorded = std::max(recorded, time.size() + runs[k].events.left_out);
    const Curve curve{std::to_string(k + 1), run_style(k), runs[k].name, &columns[k]};
    curves.push_back(curve_json(curve, axes.of(time, rows.rows), rows.rows));
  }
  json chart = chart_json(group, complete, recorded);
  chart["curves"] = std::move(curves);
  return chart;
}

/// The difference of two runs on the common grid. Both runs are exact at the grid's instants, so the
/// difference has only a rounding error.
json difference(const Compared& what, const std::vector<ComparedRun>& runs, Axes& axes) {
  Group group{.id = fmt::format("{}-difference", what.id),
              .title = fmt::format("{}, difference to 1", what.title),
              .unit = what.unit,
              .height_px = 120,
              .quantity = what.quantity};
  const Values first = column_of(runs[0].grid, what);
  const auto& time = *find_column(runs[0].grid, "t_s");
  json chart = chart_json(group, true, time.size());
  for (std::size_t k = 1; k < runs.size(); ++k) {
    Values values = column_of(runs[k].grid, what);
    const std::size_t common = std::min(values.size(), first.size());
    for (std::size_t n = 0; n < common; ++n) values[n] -= first[n];
    values.resize(time.size(), NAN);
    const Thinned rows = thinned(time, {values}, {}, 2 * difference_rows, 2 * difference_rows);
    const Curve curve{fmt::format("{} − 1", k + 1), run_style(k),
                      fmt::format("{} minus {}", runs[k].name, runs[0].name), &values};
    chart["curves"].push_back(curve_json(curve, axes.of(time, rows.rows), rows.rows));
  }
  return chart;
}

/// Packs every row of each run that is too long to be drawn without an envelope. The charts alternate: runs,
/// then their differences.
json every_row(const std::vector<ComparedRun>& runs, const std::deque<std::vector<Values>>& drawn) {
  const PlotSize size;
  json out = json::array();
  for (std::size_t k = 0; k < runs.size(); ++k) {
    const auto& time = *find_column(runs[k].events, "t_s");
    if (time.size() <= size.full || !runs[k].events.whole.empty()) continue;
    std::vector<const Values*> columns;
    std::vector<CurvePlace> places;
    for (std::size_t n = 0; n < drawn.size(); ++n) {
      columns.push_back(&drawn[n][k]);
      places.push_back({2 * n, k});
    }
    if (const auto packed = packed_rows(time, columns, size.packed_bytes / runs.size()))
      out.push_back(rows_json(*packed, places));
  }
  return out;
}

}  // namespace

const char* run_style(std::size_t place) {
  static constexpr const char* styles[most_compared] = {"a", "b", "c", "main", "reference"};
  return styles[std::min(place, most_compared - 1)];
}

double common_grid_s(const std::vector<const sixstep::study::Scenario*>& scenarios) {
  double period = INFINITY, longest = 0.0;
  for (const auto* s : scenarios) {
    period = std::min(period, s->pwm.period_s);
    longest = std::max(longest, s->duration_s);
  }
  return period * std::max(1.0, std::ceil(longest / (period * static_cast<double>(difference_rows))));
}

std::string comparison_data(const std::vector<ComparedRun>& runs) {
  json out{
      {"run", json::array()}, {"windows", json::array()}, {"axes", json::array()}, {"charts", json::array()}};
  double begin = INFINITY, end = -INFINITY;
  std::vector<std::vector<Interval>> keep;
  for (const ComparedRun& run : runs) {
    const auto* time = find_column(run.events, "t_s");
    if (!time || time->size() < 2 || !find_column(run.grid, "t_s")) return dumped(out);
    begin = std::min(begin, time->front());
    end = std::max(end, time->back());
    keep.push_back(kept(choose_windows(runs[0].events, runs[0].scenario), *time, PlotSize().full));
  }
  out["run"] = {begin, end};
  out["compared"] = true;
  out["windows"] = windows_json(choose_windows(runs[0].events, runs[0].scenario), runs[0].scenario);
  out["pole_pairs"] = runs[0].outcome->motor.machine.pole_pairs;
  Axes axes(out);
  std::deque<std::vector<Values>> drawn;  // values of the charts that overlay runs; indices: chart, run
  for (const Compared& what : compared_of(runs)) {
    std::vector<Values> columns;
    columns.reserve(runs.size());
    for (const ComparedRun& run : runs) columns.push_back(column_of(run.events, what));
    if (!worth_a_chart(what, columns, runs)) continue;
    out["charts"].push_back(overlay(what, runs, columns, keep, axes));
    out["charts"].push_back(difference(what, runs, axes));
    drawn.push_back(std::move(columns));
  }
  out["rows"] = every_row(runs, drawn);
  return dumped(out);
}

}  // namespace report

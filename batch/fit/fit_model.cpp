// SPDX-License-Identifier: Apache-2.0
#include "batch/fit/fit_model.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <string>
#include <utility>

#include "sixstep/base/written.hpp"
#include "sixstep/study/session/session.hpp"

namespace batch {

namespace {

/// Least number of rows of a fit.
constexpr std::size_t fewest_rows = 10;

/// Changes of instants and values by the probes of one bench.
struct Probes {
  explicit Probes(std::size_t columns) : gain(columns, 1.0), offset(columns, 0.0), delay_s(columns, 0.0) {}

  double shift_s = 0.0, drift = 0.0;
  std::vector<double> gain, offset, delay_s;

  /// Instant of the run at which a column had the value that the recording has at t_s.
  double instant(std::size_t column, double t_s) const {
    return t_s * (1.0 + drift) + shift_s - delay_s[column];
  }
};

Probes probes_of(const FitBench& bench, std::size_t index, std::span<const FitParameter> parameters,
                 std::span<const double> u) {
  Probes probes(bench.log.columns.size());
  probes.shift_s = bench.shift_s;
  for (std::size_t k = 0; k < parameters.size(); ++k) {
    const FitParameter& p = parameters[k];
    if (p.role == FitRole::key || p.bench != index) continue;
    const double x = p.value(u[k]);
    if (p.role == FitRole::shift) probes.shift_s = x;
    if (p.role == FitRole::drift) probes.drift = x;
    if (p.role == FitRole::offset) probes.offset[p.column] = x;
    if (p.role == FitRole::gain) probes.gain[p.column] = x;
    if (p.role == FitRole::delay) probes.delay_s[p.column] = x;
  }
  return probes;
}
}  // namespace

double FitModel::margin_s(const FitBench& bench) {
  return std::min(2.0 * bench.scenario.pwm.period_s, 0.01 * bench.scenario.duration_s);
}

base::Result<FitModel> FitModel::of(const FitBench& bench, std::size_t index) {
  FitModel model;
  model.bench_ = &bench;
  model.index_ = index;
  const std::vector<study::Column>& known = study::all_columns(bench.scenario.sheet.kind);
  for (const study::Column& column : bench.log.columns) {
    const auto found =
        std::find_if(known.begin(), known.end(), [&](const auto& k) { return k.name == column.name; });
    const auto id = static_cast<std::size_t>(found - known.begin());
    if (found == known.end() || !study::applies(static_cast<study::ColumnId>(id), bench.scenario))
      return base::Problem{bench.name, column.name, "is a column that the scenario's run does not have",
                           "leave it out, or change the scenario's control mode"};
    model.signal_.push_back(id);
    model.factor_.push_back(found->per_turning);
  }
  const double margin = margin_s(bench), from_s = margin, to_s = bench.scenario.duration_s - margin;
  const std::vector<double>& t = bench.log.values[0];
  std::size_t rows = 0;
  for (std::size_t row = 0; row < t.size(); ++row) {
    const double at_s = t[row] + bench.shift_s;
    if (!(at_s >= from_s && at_s <= to_s)) continue;
    ++rows;
    for (std::size_t c = 1; c < bench.log.columns.size(); ++c)
      if (const double x = bench.log.values[c][row]; x - x == 0.0) model.cells_.push_back({c, row, x});
  }
  if (rows < fewest_rows || model.cells_.empty())
    return base::Problem{bench.name, std::to_string(rows),
                         "rows lie within the simulated time; ten are needed",
                         "shift the recording's times, or give a longer duration_s"};
  return model;
}

base::Result<std::vector<double>> FitModel::values(std::span<const FitParameter> parameters,
                                                   std::span<const double> u, std::size_t count) const {
  const base::Result<study::Scenario> scenario = bench_with(bench_->scenario, parameters, u);
  if (!scenario) return scenario.problems();
  base::Result<study::Session> session = study::Session::open(*scenario);
  if (!session) return session.problems();
  const Probes probes = probes_of(*bench_, index_, parameters, u);
  std::vector<std::pair<double, std::size_t>> order;  // instant and cell
  order.reserve(count);
  for (std::size_t n = 0; n < count; ++n)
    order.emplace_back(std::clamp(probes.instant(cells_[n].column, bench_->log.values[0][cells_[n].row]), 0.0,
                                  scenario->duration_s),
                       n);
  if (!std::is_sorted(order.begin(), order.end())) std::sort(order.begin(), order.end());
  std::vector<double> out(count);
  double at_s = -1.0;
  for (const auto& [t_s, n] : order) {
    if (t_s > at_s && !session->advance(t_s) && session->present().t_s < t_s)
      return base::Problem{bench_->name, "t = " + base::six_digits(session->now_s()) + " s",
                           "is where the simulated drive stops, and the recording goes on",
                           "run the scenario alone: its outcome says why it stops"};
    at_s = t_s;
    const std::size_t c = cells_[n].column;
    out[n] = probes.gain[c] * factor_[c] * session->present().signals[signal_[c]] + probes.offset[c];
    if (!(out[n] - out[n] == 0.0))
      return base::Problem{bench_->name, bench_->log.columns[c].name,
                           "has no value at t = " + base::six_digits(t_s) + " s", "leave the column out"};
  }
  return out;
}

std::size_t FitModel::cells_until(double part) const {
  const std::vector<double>& t = bench_->log.values[0];
  const double first = t[cells_.front().row], last = t[cells_.back().row],
               until = first + part * (last - first);
  const auto end = std::partition_point(cells_.begin(), cells_.end(),
                                        [&](const FitCell& cell) { return t[cell.row] <= until; });
  return static_cast<std::size_t>(end - cells_.begin());
}

}  // namespace batch

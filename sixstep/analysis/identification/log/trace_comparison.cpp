// SPDX-License-Identifier: Apache-2.0
#include "sixstep/analysis/identification/log/trace_comparison.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "sixstep/base/elementary.hpp"
#include "sixstep/base/written.hpp"
#include "sixstep/study/measure/columns.hpp"

namespace sixstep::analysis {

namespace {

using Values = std::vector<double>;

const Values* values_of(const study::Trace& trace, const std::string& column) {
  for (std::size_t n = 0; n < trace.columns.size(); ++n)
    if (trace.columns[n].name == column) return &trace.values[n];
  return nullptr;
}

/// The value of a column at a time; at a jump, the value after it. Empty beyond the column's ends, and if a
/// row contains no number.
std::optional<double> value_at(const Values& t_s, const Values& values, double t) {
  const auto next = static_cast<std::size_t>(std::upper_bound(t_s.begin(), t_s.end(), t) - t_s.begin());
  if (next == 0) return {};
  const double before = values[next - 1];
  if (next == t_s.size())
    return t == t_s.back() && std::isfinite(before) ? std::optional(before) : std::nullopt;
  const double part = (t - t_s[next - 1]) / (t_s[next] - t_s[next - 1]);
  const double value = part == 0.0 ? before : before + part * (values[next] - before);
  return std::isfinite(value) ? std::optional(value) : std::nullopt;
}

/// True if the column has this label at a time: the label of either row around this time. Empty beyond the
/// column's ends.
std::optional<bool> has_label(const Values& t_s, const Values& labels, double t, double label) {
  const auto next = static_cast<std::size_t>(std::upper_bound(t_s.begin(), t_s.end(), t) - t_s.begin());
  if (next == 0 || (next == t_s.size() && t != t_s.back())) return {};
  const bool between = next < t_s.size() && t != t_s[next - 1];
  if (!std::isfinite(labels[next - 1]) || (between && !std::isfinite(labels[next]))) return {};
  return labels[next - 1] == label || (between && labels[next] == label);
}

/// The columns of one name in simulation and log, with their times.
struct Both {
  const Values *simulated_t, *simulated, *log_t, *log;
  bool labels = false;
};

std::optional<Both> both(const study::Trace& simulated, const study::Trace& log, const std::string& column) {
  const Both found{values_of(simulated, "t_s"), values_of(simulated, column), values_of(log, "t_s"),
                   values_of(log, column), study::holds_labels(column)};
  if (!found.simulated_t || !found.simulated || !found.log_t || !found.log) return {};
  return found;
}

TraceComparison compared_labels(const Both& b, double shift_s, std::size_t every) {
  TraceComparison out;
  std::size_t differing = 0;
  for (std::size_t n = 0; n < b.log_t->size(); n += every) {
    const double t = (*b.log_t)[n] + shift_s, measured = (*b.log)[n];
    if (!std::isfinite(measured)) continue;
    const std::optional<bool> same = has_label(*b.simulated_t, *b.simulated, t, measured);
    if (!same) continue;
    ++out.rows;
    if (*same) continue;
    if (differing++ == 0) out.at_s = t;
  }
  out.differing = differing;
  if (out.rows == 0) return out;
  out.span = 1.0;
  out.rms = std::sqrt(static_cast<double>(differing) / static_cast<double>(out.rows));
  return out;
}

/// Compares each `every`-th row.
TraceComparison compared(const Both& b, double shift_s, std::size_t every = 1) {
  if (b.labels) return compared_labels(b, shift_s, every);
  TraceComparison out;
  double low = std::numeric_limits<double>::infinity(), high = -low, squares = 0.0;
  for (std::size_t n = 0; n < b.log_t->size(); n += every) {
    const double t = (*b.log_t)[n] + shift_s, measured = (*b.log)[n];
    const std::optional<double> there = value_at(*b.simulated_t, *b.simulated, t);
    if (!there || !std::isfinite(measured)) continue;
    const double apart = measured - *there;
    low = std::min(low, *there);
    high = std::max(high, *there);
    squares += apart * apart;
    ++out.rows;
    if (std::abs(apart) > std::abs(out.greatest)) {
      out.greatest = apart;
      out.at_s = t;
    }
  }
  if (out.rows == 0) return out;
  out.span = high - low;
  out.rms = std::sqrt(squares / static_cast<double>(out.rows));
  return out;
}

}  // namespace

std::vector<TraceComparison> trace_comparison(const study::Trace& simulated, const study::Trace& log,
                                              double shift_s) {
  std::vector<TraceComparison> out;
  for (const study::Column& column : log.columns) {
    if (column.name == "t_s") continue;
    const std::optional<Both> found = both(simulated, log, column.name);
    if (!found) continue;
    TraceComparison one = compared(*found, shift_s);
    one.column = column;
    if (one.rows > 0) out.push_back(std::move(one));
  }
  return out;
}

namespace {

/// Smallest difference of two values of a column.
double least_step(Values values) {
  std::sort(values.begin(), values.end());
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t n = 1; n < values.size(); ++n)
    if (values[n] > values[n - 1]) least = std::min(least, values[n] - values[n - 1]);
  return std::isfinite(least) ? least : 0.0;
}

/// A column that is used to find the shift.
struct Weighed {
  Both both;
  double scale = 1.0;  ///< the column's span, or the least step of its log
  double step = 0.0;
  double floor =
      0.0;  ///< rms that the column's resolution alone causes: 1/sqrt(12) of the step; for labels, half a row
  std::size_t rows = 0;  ///< rows that can be compared without a shift
};

std::vector<Weighed> weighed_columns(const study::Trace& simulated, const study::Trace& log,
                                     std::size_t every) {
  std::vector<Weighed> out;
  for (const study::Column& column : log.columns) {
    const std::optional<Both> found = both(simulated, log, column.name);
    if (column.name == "t_s" || !found) continue;
    const TraceComparison here = compared(*found, 0.0, every);
    constexpr double rms_of_a_step = 0.28867513459481287;
    const double step = found->labels ? 0.0 : least_step(*found->log), scale = std::max(here.span, step);
    const double rows = static_cast<double>(std::max<std::size_t>(here.rows, 1));
    const double floor = found->labels ? std::sqrt(0.5 / rows) : rms_of_a_step * step;
    if (scale > 0.0) out.push_back({*found, scale, step, floor, here.rows});
  }
  // A column that never has a value in the run has no common row at any shift.
  if (std::any_of(out.begin(), out.end(), [](const Weighed& w) { return w.rows > 0; }))
    std::erase_if(out, [](const Weighed& w) { return w.rows == 0; });
  return out;
}

/// Geometric mean of the columns' rms, relative to their scales. This is the likelihood if the accuracy of
/// each column is unknown. A column that fits at no shift, such as a duty that acts a period later, then does
/// not outweigh a column that fits. Empty if a shift has too few common rows, because such a shift would have
/// the least rms.
struct Apart {
  double rms = 0.0;
  bool within_steps = true;  ///< true: no column's rms exceeds the step of its log
};
std::optional<Apart> apart(const std::vector<Weighed>& columns, double shift_s, std::size_t every) {
  constexpr double least_part = 1e-6;
  double logs = 0.0;
  Apart out;
  for (const Weighed& column : columns) {
    const TraceComparison one = compared(column.both, shift_s, every);
    if (one.rows == 0 || one.rows < column.rows / 2) return {};
    const double left = std::max(one.rms, column.floor) / column.scale;
    logs += base::log(std::max(left, least_part));
    out.within_steps &= one.rms <= column.step;
  }
  out.rms = base::exp(logs / static_cast<double>(columns.size()));
  return out;
}

}  // namespace

double best_shift_s(const study::Trace& simulated, const study::Trace& log, double most_s, double step_s) {
  // The difference has many minima if a current ripples. The search therefore uses a grid, and then finer
  // grids around the best value.
  constexpr int asked_values = 4000, times_finer = 10, grids = 4;
  constexpr double counts = 1e-3, much_less = 0.9;
  const Values* const times = values_of(log, "t_s");
  if (!times || !(most_s >= step_s) || !(step_s > 0.0)) return 0.0;
  const std::size_t every = times->size() * log.columns.size() / asked_values + 1;
  const std::vector<Weighed> columns = weighed_columns(simulated, log, every);
  if (columns.empty()) return 0.0;
  const std::optional<Apart> unmoved = apart(columns, 0.0, every);
  if (unmoved && unmoved->within_steps) return 0.0;
  double best = 0.0, least = unmoved ? unmoved->rms : std::numeric_limits<double>::infinity(), middle = 0.0;
  for (int grid = 0; grid < grids; ++grid, most_s = step_s, step_s /= times_finer, middle = best) {
    const auto each_way = static_cast<int>(most_s / step_s);
    for (int n = -each_way; n <= each_way; ++n) {
      const std::optional<Apart> there = apart(columns, middle + step_s * n, every);
      if (!there || there->rms >= least) continue;
      least = there->rms;
      best = middle + step_s * n;
    }
  }
  const bool gains = !unmoved || (unmoved->rms - least > counts && least < much_less * unmoved->rms);
  return gains ? best : 0.0;
}

double start_shift_s(const study::Trace& simulated, const study::Trace& log) {
  const Values *const there = values_of(simulated, "t_s"), *const here = values_of(log, "t_s");
  if (!there || !here || there->empty() || here->empty()) return 0.0;
  const bool meets = std::any_of(here->begin(), here->end(),
                                 [&](double t) { return t >= there->front() && t <= there->back(); });
  return meets ? 0.0 : -here->front();
}

base::Result<Overlay> overlay(const std::string& name, const study::Trace& simulated, const study::Trace& log,
                              double shift_s) {
  Overlay out;
  const Values *const there = values_of(simulated, "t_s"), *const here = values_of(log, "t_s");
  if (there && here && !there->empty())
    for (const double t : *here)
      out.inside += t + shift_s >= there->front() && t + shift_s <= there->back() ? 1 : 0;
  out.rows = here ? here->size() : 0;
  const std::vector<TraceComparison> found = trace_comparison(simulated, log, shift_s);
  for (const study::Column& column : log.columns) {
    if (column.name == "t_s") continue;
    const auto one = std::find_if(found.begin(), found.end(),
                                  [&](const TraceComparison& f) { return f.column.name == column.name; });
    if (one == found.end())
      out.left_out.push_back({column.name, "the run has no values of this column at these times"});
    else if (one->rows < fewest_compared)
      out.left_out.push_back({column.name, "only in " + std::to_string(one->rows) + " rows"});
    else
      out.columns.push_back(*one);
  }
  if (!out.columns.empty()) return out;
  const bool few = out.inside < fewest_compared && there && here && !there->empty() && !here->empty();
  return base::Problem{
      .where = name + ":",
      .limit = few ? "has " + std::to_string(out.inside) + " of " + std::to_string(out.rows) +
                         " rows in the simulated time, " + base::six_digits(there->front()) + " to " +
                         base::six_digits(there->back()) + " s; the log covers " +
                         base::six_digits(here->front() + shift_s) + " to " +
                         base::six_digits(here->back() + shift_s) + " s, and " +
                         std::to_string(fewest_compared) + " are needed"
                   : "has no column with " + std::to_string(fewest_compared) +
                         " rows at which this run has a value",
      .cure = few ? "correct the unit of the log's time, or give the offset of the log's clock"
                  : "name columns for which the simulated drive has values"};
}

study::Trace at_instants(const study::Trace& log, double shift_s, const std::vector<double>& t_s) {
  study::Trace out{.columns = log.columns, .values = std::vector<Values>(log.columns.size())};
  const Values* const times = values_of(log, "t_s");
  for (std::size_t n = 0; n < out.columns.size(); ++n) {
    if (out.columns[n].name == "t_s") {
      out.values[n] = t_s;
      continue;
    }
    for (const double t : t_s)
      out.values[n].push_back(
          value_at(*times, log.values[n], t - shift_s).value_or(std::numeric_limits<double>::quiet_NaN()));
  }
  return out;
}

}  // namespace sixstep::analysis

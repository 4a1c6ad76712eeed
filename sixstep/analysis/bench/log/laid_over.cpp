// SPDX-License-Identifier: Apache-2.0
#include "sixstep/analysis/bench/log/laid_over.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

namespace sixstep::analysis {

namespace {

using Values = std::vector<double>;

const Values* values_of(const study::Trace& trace, const std::string& column) {
  for (std::size_t n = 0; n < trace.columns.size(); ++n)
    if (trace.columns[n].name == column) return &trace.values[n];
  return nullptr;
}

/// A column along its rising times. Behind a jump at that very instant; nothing beyond the ends, nor where a row holds no number.
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

/// The columns of one name in both, with their times.
struct Both {
  const Values *simulated_t, *simulated, *log_t, *log;
};

std::optional<Both> both(const study::Trace& simulated, const study::Trace& log, const std::string& column) {
  const Both found{values_of(simulated, "t_s"), values_of(simulated, column), values_of(log, "t_s"),
                   values_of(log, column)};
  if (!found.simulated_t || !found.simulated || !found.log_t || !found.log) return {};
  return found;
}

/// Of every so manieth row.
LaidOver compared(const Both& b, double shift_s, std::size_t every = 1) {
  LaidOver out;
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

std::vector<LaidOver> laid_over(const study::Trace& simulated, const study::Trace& log, double shift_s) {
  std::vector<LaidOver> out;
  for (const study::Column& column : log.columns) {
    if (column.name == "t_s") continue;
    const std::optional<Both> found = both(simulated, log, column.name);
    if (!found) continue;
    LaidOver one = compared(*found, shift_s);
    one.column = column;
    if (one.rows > 0) out.push_back(std::move(one));
  }
  return out;
}

double best_shift_s(const study::Trace& simulated, const study::Trace& log, const std::string& column,
                    double most_s, double step_s) {
  const std::optional<Both> found = both(simulated, log, column);
  if (!found || !(most_s >= step_s) || !(step_s > 0.0)) return 0.0;
  // The difference has many lows where a current ripples: looked for on a grid, then on finer ones around the best.
  constexpr int rows = 2000, times_finer = 10, grids = 4;
  const std::size_t every = found->log_t->size() / rows + 1;
  double best = 0.0, least = std::numeric_limits<double>::infinity(), middle = 0.0;
  // A shift that leaves little to compare would always win.
  const std::size_t enough = compared(*found, 0.0, every).rows / 2;
  for (int grid = 0; grid < grids; ++grid, most_s = step_s, step_s /= times_finer, middle = best) {
    const auto each_way = static_cast<int>(most_s / step_s);
    for (int n = -each_way; n <= each_way; ++n) {
      const double shift = middle + step_s * n;
      const LaidOver one = compared(*found, shift, every);
      if (one.rows == 0 || one.rows < enough || one.rms >= least) continue;
      least = one.rms;
      best = shift;
    }
  }
  return best;
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

// SPDX-License-Identifier: Apache-2.0
#include "report/kept_rows.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <numeric>

#include "report/highlights.hpp"
#include "report/windows.hpp"
#include "sixstep/study/measure/columns.hpp"

namespace report {
namespace {

using sixstep::study::Scenario;
using sixstep::study::Trace;

constexpr double end_of_time = std::numeric_limits<double>::infinity();

/// Rows per bucket: the first row, the last row, and the rows of each column's lowest and highest value.
constexpr std::size_t rows_a_bucket = 2 * sixstep::study::column_count + 2;

std::size_t row_at(const std::vector<double>& time, double t_s) {
  return static_cast<std::size_t>(std::ranges::lower_bound(time, t_s) - time.begin());
}

/// Expected number of rows in a run.
double expected_rows(const Scenario& s) {
  // With soft chopping there are seven rows per period: rows of a tick and of two edges, with both sides of
  // each jump.
  constexpr double rows_a_period = 7.0;
  return s.duration_s / s.pwm.period_s * rows_a_period;
}
double expected_bytes(const Scenario& s) {
  return expected_rows(s) * sizeof(double) * sixstep::study::column_count;
}

}  // namespace

KeptRows::KeptRows(const Scenario& scenario, std::size_t most_bytes)
    : scenario_(&scenario),
      most_(std::max(most_bytes / (sizeof(double) * sixstep::study::column_count), 16 * rows_a_bucket)) {
  trace_.columns = sixstep::study::all_columns();
  trace_.values.resize(trace_.columns.size());
  trace_.every_event = true;
  // Reserved memory costs nothing until rows are stored in it. Without the reservation, a column would be
  // copied each time its size doubles.
  const double expected = std::min(expected_rows(scenario), static_cast<double>(most_));
  if (expected > 0.0)
    for (std::vector<double>& column : trace_.values) column.reserve(static_cast<std::size_t>(expected) + 1);
}

void KeptRows::add(sixstep::study::Row row) {
  if (rows() == most_) thin();
  for (std::size_t n = 0; n < row.size(); ++n) trace_.values[n].push_back(row[n]);
}

/// Replaces the older half of the complete rows by an envelope of a sixteenth as many rows. If the envelope
/// exceeds a quarter of all rows, it is replaced by an envelope of half as many rows.
void KeptRows::thin() {
  const std::size_t before = rows(), end = thinned_ + (before - thinned_) / 2;
  step_ = step_to_keep(end);
  keep_envelope(thinned_, end, (end - thinned_) / 16 / rows_a_bucket);
  thinned_ = end - (before - rows());
  if (thinned_ > most_ / 4) {
    const std::size_t with_old = rows();
    keep_envelope(0, thinned_, thinned_ / 2 / rows_a_bucket);
    thinned_ -= with_old - rows();
  }
  trace_.left_out += before - rows();
  say_what_is_whole();
}

/// The largest step so far, if all its rows still exist and are at most an eighth of all rows.
std::optional<Interval> KeptRows::step_to_keep(std::size_t end) const {
  const auto step = largest_step(trace_, *scenario_);
  if (!step || step->of == "start" || !is_whole(trace_, step->window)) return std::nullopt;
  const std::vector<double>& time = trace_.values.front();
  const std::size_t first = row_at(time, step->window.from),
                    last = std::min(end, row_at(time, step->window.to));
  if (first < last && last - first > most_ / 8) return std::nullopt;
  return step->window;
}

void KeptRows::keep_envelope(std::size_t begin, std::size_t end, std::size_t buckets) {
  const std::vector<double>& time = trace_.values.front();
  Curves curves;
  for (std::size_t c = 1; c < trace_.values.size(); ++c) curves.emplace_back(trace_.values[c].data(), end);
  std::vector<std::size_t> rows(end - begin), detail;
  std::iota(rows.begin(), rows.end(), begin);
  for (const std::size_t n : rows)
    if (step_ && step_->holds(time[n])) detail.push_back(n);
  const std::vector<std::size_t> coarse = envelope(time, rows, curves, std::max<std::size_t>(buckets, 1));
  rows.clear();
  std::ranges::set_union(coarse, detail, std::back_inserter(rows));
  for (std::vector<double>& column : trace_.values) {
    for (std::size_t n = 0; n < rows.size(); ++n) column[begin + n] = column[rows[n]];
    column.erase(column.begin() + static_cast<std::ptrdiff_t>(begin + rows.size()),
                 column.begin() + static_cast<std::ptrdiff_t>(end));
  }
}

void KeptRows::say_what_is_whole() {
  const double from_s = trace_.values.front()[thinned_];
  trace_.whole.clear();
  if (step_ && step_->to >= from_s) {
    trace_.whole.push_back({std::min(step_->from, from_s), end_of_time});
    return;
  }
  if (step_) trace_.whole.push_back({step_->from, step_->to});
  trace_.whole.push_back({from_s, end_of_time});
}

std::string rows_foretold(const Scenario& s, std::size_t most_bytes) {
  const double bytes = expected_bytes(s), most = static_cast<double>(most_bytes);
  if (!(bytes > 1.5 * most)) return "";
  return fmt::format(
      "the run's events need about {:.0f} MB, but a report keeps only {:.0f} MB: every event before the run's end and during the largest step, and an envelope of the other events; the page states from which time on every event is kept",
      bytes / 1e6, most / 1e6);
}

std::string rows_told(const Trace& trace) {
  if (trace.whole.empty()) return "";
  std::string where;
  if (trace.whole.size() > 1)
    where =
        fmt::format("from {:.6g} s to {:.6g} s and ", trace.whole.front().from_s, trace.whole.front().to_s);
  return fmt::format(
      "the report has every event {}from {:.6g} s on; an envelope with each peak replaces {} other events, "
      "because the rows of all events would take too much memory",
      where, trace.whole.back().from_s, trace.left_out);
}

}  // namespace report

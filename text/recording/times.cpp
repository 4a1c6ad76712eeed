// SPDX-License-Identifier: Apache-2.0
#include "text/recording/times.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "text/keys/units.hpp"
#include "text/recording/known_names.hpp"

namespace text {
namespace {

bool is_in_seconds(const RecordedColumn& column) {
  return !column.unit.empty() && same_kind(*unit_of(column.unit), *unit_of("s"));
}

/// Whether the values are an oscilloscope's sample numbers: 0, 1, 2 or 1, 2, 3.
bool are_numbers_of_rows(const std::vector<double>& values) {
  for (std::size_t n = 0; n < values.size(); ++n)
    if (values[n] - values[0] != static_cast<double>(n)) return false;
  return values.size() > 2;
}

/// The nonzero differences between successive times: least, median and greatest.
struct Steps {
  double least = 0.0, middle = 0.0, greatest = 0.0;
  bool even() const { return greatest < 1.5 * least; }
};
Steps steps_of(const std::vector<double>& t) {
  std::vector<double> steps;
  for (std::size_t n = 1; n < t.size(); ++n)
    if (t[n] > t[n - 1]) steps.push_back(t[n] - t[n - 1]);
  if (steps.empty()) return {};
  const auto middle = steps.begin() + static_cast<std::ptrdiff_t>(steps.size() / 2);
  std::nth_element(steps.begin(), middle, steps.end());
  const double at_middle = *middle;
  const auto [least, greatest] = std::minmax_element(steps.begin(), steps.end());
  return {*least, at_middle, *greatest};
}

bool are_near(double a, double b) { return std::fabs(a - b) <= 0.01 * b; }

/// Whether each step is a whole number of intervals, within the precision of the file's digits.
bool are_whole(const std::vector<double>& t, double factor, double interval_s) {
  for (std::size_t n = 1; n < t.size(); ++n) {
    const double steps = (t[n] - t[n - 1]) * factor / interval_s;
    if (steps < 0.99 || std::fabs(steps - std::floor(steps + 0.5)) > 0.02 + 1e-3 * steps) return false;
  }
  return true;
}

struct TimeUnit {
  const char* name;
  double per_s;
};
constexpr TimeUnit time_units[] = {{"ns", 1e9}, {"us", 1e6}, {"ms", 1e3}, {"s", 1.0}};

/// The unit for which a column without a unit agrees with the preamble; null if there is none. If rows are
/// recorded only at changes, they are whole numbers of samples apart in every larger unit too. So the
/// smallest unit is chosen.
const TimeUnit* unit_by_clock(const std::vector<double>& t, const Steps& steps, double interval_s) {
  for (const TimeUnit& unit : time_units)
    if (steps.even() && are_near(steps.middle / unit.per_s, interval_s)) return &unit;
  for (const TimeUnit& unit : time_units)
    if (are_whole(t, 1.0 / unit.per_s, interval_s)) return &unit;
  return nullptr;
}

/// Whether times agree with an interval. A given interval may be rounded to three digits, and times are
/// rounded or cut at their last digit.
bool go_with(const std::vector<double>& t, double interval_s) {
  const double digit = 0.99 * steps_of(t).least;
  for (std::size_t n = 1; n < t.size(); ++n) {
    const double way = static_cast<double>(n) * interval_s;
    if (std::fabs(t[n] - t[0] - way) > digit + 1e-3 * way) return false;
  }
  return steps_of(t).middle > 0.0;
}

std::vector<double> rows_from(double start_s, double interval_s, std::size_t rows) {
  std::vector<double> out(rows);
  for (std::size_t n = 0; n < rows; ++n) out[n] = start_s + static_cast<double>(n) * interval_s;
  return out;
}

/// Whether the column of time is a guess: without headings the first column may be the time or any other
/// quantity.
bool is_a_guess(const Recording& r, const RecordedColumn& column) {
  return !r.has_headings && column.unit.empty();
}

/// Times without a column of time, from the preamble's rate or the given interval.
base::Result<Times> without_column(const Recording& r, std::optional<double> interval_s, Notes& notes) {
  if (interval_s && r.clock && !are_near(*interval_s, r.clock->interval_s))
    return of_recording(
        r, fmt::format("says \"{}\", but the given interval is {:.6g} s", r.clock->said, *interval_s),
        "leave the interval out, or give the interval that the file states");
  if (!interval_s)
    notes.push_back(
        fmt::format("has no column of time; the rows are {:.6g} s apart, as the file says: \"{}\"",
                    r.clock->interval_s, r.clock->said));
  const double start_s = interval_s ? 0.0 : r.clock->start_s;
  return Times{.t_s = rows_from(start_s, interval_s.value_or(r.clock ? r.clock->interval_s : 0.0), r.rows()),
               .left_out = {},
               .column = nullptr};
}

/// A column without a unit gets the unit that agrees with the interval. A guessed column that cannot be a
/// time is not used.
base::Result<Times> column_at_interval(const Recording& r, const RecordedColumn& column, double interval_s,
                                       Notes& notes) {
  const bool guessed = is_a_guess(r, column);
  if (!column.has_numbers() || (guessed && column.bad_cells > 0)) return without_column(r, interval_s, notes);
  base::Result<std::vector<double>> t = values_of(r, {&column, column.unit}, "s");
  if (!t) return t.problems();
  if (column.unit.empty() && are_numbers_of_rows(*t))
    return Times{.t_s = rows_from(0.0, interval_s, r.rows()), .left_out = {}, .column = &column};
  for (const TimeUnit& unit : time_units) {
    if (!column.unit.empty() || unit.per_s == 1.0) continue;
    std::vector<double> in_s = *t;
    for (double& x : in_s) x /= unit.per_s;
    if (!go_with(in_s, interval_s)) continue;
    notes.push_back(fmt::format("{} has no unit; {} is assumed, which agrees with the given interval",
                                column.name, unit.name));
    return times_at_interval(r, std::move(in_s), column, interval_s, notes);
  }
  if (guessed && !go_with(*t, interval_s)) {
    if (steps_of(*t).even() && std::is_sorted(t->begin(), t->end()))
      notes.push_back(fmt::format(
          "{} rises by {:.6g} from row to row, but is not used as the time, because the interval is given",
          column.name, steps_of(*t).middle));
    return without_column(r, interval_s, notes);
  }
  return times_at_interval(r, std::move(*t), column, interval_s, notes);
}

/// Whether the preamble contradicts the rows: steps finer than the sampling, or different by a factor of a
/// thousand or more.
bool contradict(const Steps& steps, double interval_s) {
  return steps.least < 0.99 * interval_s || (steps.even() && steps.middle > 999.0 * interval_s);
}

/// The column's values in s, compared with the preamble if there is one.
base::Result<std::vector<double>> by_clock(const Recording& r, const RecordedColumn& column,
                                           std::vector<double> t, Notes& notes) {
  if (!r.clock) return t;
  const double interval_s = r.clock->interval_s;
  const bool bare = column.unit.empty();
  if (bare && are_numbers_of_rows(t)) {
    notes.push_back(
        fmt::format("{} contains row numbers; the rows are {:.6g} s apart, as the file says: \"{}\"",
                    column.name, interval_s, r.clock->said));
    for (std::size_t n = 0; n < t.size(); ++n) t[n] = r.clock->start_s + static_cast<double>(n) * interval_s;
    return t;
  }
  const Steps steps = steps_of(t);
  if (steps.middle == 0.0) return t;
  if (bare)
    if (const TimeUnit* const unit = unit_by_clock(t, steps, interval_s); unit && unit->per_s != 1.0) {
      notes.push_back(fmt::format("{} is read in {}, because the file says \"{}\"", column.name, unit->name,
                                  r.clock->said));
      for (double& x : t) x /= unit->per_s;
      return t;
    }
  if (!contradict(steps, interval_s)) {
    if (steps.even() && !are_near(steps.middle, interval_s))
      notes.push_back(fmt::format("the rows are {:.4g} s apart, but \"{}\" says {:.4g} s", steps.middle,
                                  r.clock->said, interval_s));
    return t;
  }
  return of_recording(
      r,
      fmt::format("contradicts itself: {} rises by {:.6g} s from row to row, but \"{}\" says {:.6g} s",
                  column.name, steps.middle, r.clock->said, interval_s),
      "write the right unit in the heading, for example time [us], or give the interval of the rows");
}

}  // namespace

const RecordedColumn* time_column(const Recording& recording) {
  const auto named = [](const RecordedColumn& column) { return names_a_time(column.bare); };
  const auto found = std::find_if(recording.columns.begin(), recording.columns.end(), named);
  if (found != recording.columns.end()) return &*found;
  const auto timed = std::find_if(recording.columns.begin(), recording.columns.end(), is_in_seconds);
  if (timed != recording.columns.end()) return &*timed;
  const bool bare = recording.columns.size() > 1 && !recording.has_headings && !recording.clock;
  return bare ? &recording.columns.front() : nullptr;
}

base::Result<Times> rising_times(const Recording& recording, std::vector<double> t,
                                 const RecordedColumn& column, Notes& notes) {
  const auto does_not_rise = [&](std::size_t row) {
    return of_recording(
        recording, fmt::format("{} {:.10g} in row {} does not rise", column.name, t[row], row + 1),
        recording.has_headings
            ? "give the rows in the order of recording and with all digits of the time, or give the interval of the rows"
            : "give headings that name the column of the time, or give the interval of the rows; without headings the first column is the time");
  };
  Times out{.t_s = {}, .left_out = {}, .column = &column};
  for (std::size_t n = 1; n < t.size(); ++n) {
    if (t[n] < t[n - 1]) return does_not_rise(n);
    if (t[n] == t[n - 1]) out.left_out.push_back(n - 1);
  }
  // At most one time in `one_in` may be a repetition. Sometimes two events have the same time; a time with
  // too few digits repeats everywhere.
  constexpr std::size_t one_in = 10;
  if (out.left_out.size() * one_in > t.size()) return does_not_rise(out.left_out[0] + 1);
  if (!out.left_out.empty())
    notes.push_back(fmt::format("{} {} left out: the next row has the same time (first in line {})",
                                out.left_out.size(), out.left_out.size() == 1 ? "row" : "rows",
                                recording.line_of(out.left_out[0])));
  out.t_s = without_rows(std::move(t), out.left_out);
  return out;
}

base::Result<Times> times_at_interval(const Recording& recording, std::vector<double> t,
                                      const RecordedColumn& column, double interval_s, Notes& notes) {
  if (!go_with(t, interval_s))
    return of_recording(
        recording,
        fmt::format("contradicts the given interval of {:.6g} s: {} rises by {:.6g} s from row to row",
                    interval_s, column.name, steps_of(t).middle),
        "leave the interval out, or write the right unit in the heading, for example time [us]");
  // The interval is needed only for times with too few digits.
  if (steps_of(t).even() && std::adjacent_find(t.begin(), t.end()) == t.end())
    return rising_times(recording, std::move(t), column, notes);
  return Times{.t_s = rows_from(t[0], interval_s, t.size()), .left_out = {}, .column = &column};
}

base::Result<Times> times_of(const Recording& recording, std::optional<double> interval_s, Notes& notes) {
  const RecordedColumn* const column = time_column(recording);
  if (column && interval_s) return column_at_interval(recording, *column, *interval_s, notes);
  if (!column && (interval_s || recording.clock)) return without_column(recording, interval_s, notes);
  if (!column)
    return of_recording(recording, "has no column of time: it has " + headings_of(recording),
                        "write the heading time [s], or give the interval of the rows");
  base::Result<std::vector<double>> values = values_of(recording, {column, column->unit}, "s");
  if (!values) return values.problems();
  if (column->unit.empty() && !recording.clock && are_numbers_of_rows(*values))
    return of_recording(recording,
                        fmt::format("has no time: its column {} contains only row numbers", column->name),
                        "write the heading time [s] if these are seconds, or give the interval of the rows");
  base::Result<std::vector<double>> t_s = by_clock(recording, *column, std::move(*values), notes);
  if (!t_s) return t_s.problems();
  return rising_times(recording, std::move(*t_s), *column, notes);
}

}  // namespace text

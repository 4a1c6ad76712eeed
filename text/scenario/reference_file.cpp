// SPDX-License-Identifier: Apache-2.0
#include "text/scenario/reference_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string_view>
#include <utility>

#include "sixstep/base/plausible.hpp"
#include "text/keys/bounded.hpp"
#include "text/keys/key_advice.hpp"
#include "text/recording/columns.hpp"

namespace text {
namespace {

/// Upper limit of reported lines, because a file that is no table has an error in every line.
constexpr std::size_t most_told = 5;

/// The first column: its unit, and its names in messages.
struct FirstColumn {
  const char *unit, *word, *row;
  bool selects;  ///< true: a key selects one of several columns of values
};
constexpr FirstColumn first_is_time{"s", "time", "a time in s and a value", true},
    angle_column{"deg", "angle", "an angle in degrees and a value", false};

class RowsOf {
 public:
  RowsOf(const Recording& recording, const FirstColumn& first, std::string unit)
      : r_(recording), first_(first), unit_(std::move(unit)) {}

  base::Result<ReferenceRows> with(const std::optional<std::string>& column) {
    const base::Result<Picked> picked = values_column(column);
    if (!picked) return picked.problems();
    const RecordedColumn& times = r_.columns.front();
    tell_bad_cells(times);
    if (picked->column != &times) tell_bad_cells(*picked->column);
    const base::Result<std::vector<double>> t = converted(r_, {&times, times.unit}, first_.unit),
                                            y = converted(r_, *picked, unit_);
    if (!t) return t.problems();
    if (!y) return y.problems();
    // Stops at the first cell that is not a number, because the order of the times cannot be checked across
    // this cell.
    for (std::size_t row = 0; bad_ == 0 && row < t->size(); ++row) take(row, (*t)[row], (*y)[row]);
    if (told_.empty()) return std::move(rows_);
    std::stable_sort(told_.begin(), told_.end(),
                     [](const auto& a, const auto& b) { return a.first < b.first; });
    base::Problems out;
    for (std::size_t n = 0; n < std::min(most_told, told_.size()); ++n) out.push_back(told_[n].second);
    const std::size_t more = std::max(bad_, told_.size()) - out.size();
    if (more > 0)
      out.push_back({.where = r_.name + ":",
                     .limit = fmt::format("has wrong rows in {} more lines", more),
                     .cure = fmt::format("each row is {}", first_.row)});
    return out;
  }

 private:
  base::Result<Picked> values_column(const std::optional<std::string>& column) {
    if (!column) {
      if (r_.columns.size() < 2)
        return at_line(r_.line_of(0), "has 1 column", fmt::format("each row is {}", first_.row));
      if (r_.columns.size() > 2) return which_column();
      return Picked{&r_.columns[1], r_.columns[1].unit};
    }
    if (!r_.has_headings)
      return at_line(
          r_.line_of(0), "has no headings",
          fmt::format("write headings in the first line, and the heading \"{}\" above the wanted column",
                      *column));
    const base::Result<std::vector<Picked>> found = columns_called(r_, {*column});
    if (!found) return found.problems();
    return found->front();
  }

  /// The problem of a table with many columns, in which the second column need not be the wanted quantity.
  base::Problem which_column() const {
    std::string names;
    for (std::size_t n = 1; n < r_.columns.size(); ++n)
      names += fmt::format("{}\"{}\"", n == 1 ? "" : ", ", r_.columns[n].name);
    const std::string keep = fmt::format("keep two columns: {}", first_.row);
    return at_line(r_.line_of(0), fmt::format("has {} columns: {}", r_.columns.size(), names),
                   r_.has_headings && first_.selects ? "name the column in reference.column" : keep);
  }

  /// Reports cells that are not numbers, each line once.
  void tell_bad_cells(const RecordedColumn& column) {
    bad_ = std::max(bad_, column.bad_cells);
    for (const BadCell& bad : column.bad)
      if (std::none_of(told_.begin(), told_.end(), [&](const auto& told) { return told.first == bad.line; }))
        told_.emplace_back(bad.line,
                           at_line(bad.line, fmt::format("{} \"{}\" is not a number", column.name, bad.cell),
                                   "write numbers as 0.5 or 5e-1"));
  }

  void take(std::size_t row, double t, double y) {
    if (!allowed(row, t, first_.unit, first_.word) || !allowed(row, y, unit_, "value")) return;
    const double at = not_nearly(t);
    const bool rises = rows_.times_s.empty() ? at >= 0.0 : at > rows_.times_s.back();
    if (!rises)
      return say(row, fmt::format("{} {} is not above the row before", first_.word, at),
                 fmt::format("sort the rows; the first may be 0 {}", first_.unit));
    rows_.times_s.push_back(at);
    rows_.values.push_back(not_nearly(y));
  }

  bool allowed(std::size_t row, double x, const std::string& unit, std::string_view what) {
    base::Range range = base::allowed(base::Range{}, unit);
    range.least = 0.0;
    if (range.holds(x)) return true;
    const std::string in = unit.empty() ? "" : ", in " + unit;
    say(row, fmt::format("{} {} {}{}", what, x, limit_of(range), in), "check the unit of this column");
    return false;
  }

  /// A recorded trace decays exponentially and never reaches 0: values near zero become 0.
  static double not_nearly(double x) { return std::fabs(x) < base::nearly_nothing ? 0.0 : x; }

  base::Problem at_line(std::size_t line, std::string limit, std::string cure) const {
    return bounded({.where = fmt::format("{}:{}:", r_.name, line),
                    .value = {},
                    .limit = bounded(std::move(limit), 400),
                    .cure = std::move(cure)});
  }
  void say(std::size_t row, std::string limit, std::string cure) {
    const std::size_t line = r_.line_of(row);
    told_.emplace_back(line, at_line(line, std::move(limit), std::move(cure)));
  }

  const Recording& r_;
  const FirstColumn& first_;
  std::string unit_;
  ReferenceRows rows_;
  std::size_t bad_ = 0;  ///< number of cells that are no numbers, quoted or not
  std::vector<std::pair<std::size_t, base::Problem>> told_;  ///< problems with their lines
};

base::Result<ReferenceRows> rows_of(const std::string& name, const std::string& text,
                                    const FirstColumn& first, const std::optional<std::string>& column,
                                    const std::string& unit) {
  const base::Result<Recording> recording = read_recording(name, text);
  if (!recording) return recording.problems();
  return RowsOf(*recording, first, unit).with(column);
}

}  // namespace

base::Result<ReferenceRows> reference_rows(const std::string& name, const std::string& text,
                                           const std::optional<std::string>& column,
                                           const std::string& unit) {
  return rows_of(name, text, first_is_time, column, unit);
}

base::Result<ShapeRows> shape_rows(const std::string& name, const std::string& text) {
  base::Result<ReferenceRows> rows = rows_of(name, text, angle_column, {}, "");
  if (!rows) return rows.problems();
  return ShapeRows{std::move(rows->times_s), std::move(rows->values)};
}

}  // namespace text

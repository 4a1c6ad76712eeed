// SPDX-License-Identifier: Apache-2.0
#include "text/scenario/reference_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string_view>
#include <utility>

#include "sixstep/base/plausible.hpp"
#include "text/keys/bounded.hpp"
#include "text/keys/decimal_number.hpp"
#include "text/keys/key_advice.hpp"
#include "text/keys/units.hpp"

namespace text {
namespace {

/// So many lines are told of; of a file that is no table at all every one would be.
constexpr std::size_t most_told = 5;

constexpr std::string_view blanks_and_quotes = " \t\r\"";

std::string_view bare_cell(std::string_view text) {
  const std::size_t first = text.find_first_not_of(blanks_and_quotes);
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(blanks_and_quotes) - first + 1);
}

char separator_of(std::string_view line) {
  for (const char c : {';', ',', '\t'})
    if (line.find(c) != std::string_view::npos) return c;
  return ' ';
}

/// Of a line of more columns the rest is left alone.
constexpr std::size_t most_columns = 10'000;

std::vector<std::string_view> cells_of(std::string_view line, char separator) {
  std::vector<std::string_view> cells;
  while (!line.empty() && cells.size() < most_columns) {
    const std::size_t cut = std::min(line.find(separator), line.size());
    const std::string_view cell = bare_cell(line.substr(0, cut));
    if (separator != ' ' || !cell.empty()) cells.emplace_back(cell);
    line.remove_prefix(std::min(cut + 1, line.size()));
  }
  return cells;
}

std::optional<double> number_of(std::string_view text, char separator) {
  std::string cell(text);
  if (separator == ';') std::replace(cell.begin(), cell.end(), ',', '.');
  if (cell.starts_with('+')) cell.erase(0, 1);
  const DecimalNumber x = decimal_number(cell);
  if (x.kind != DecimalNumber::Kind::number || x.size != cell.size()) return {};
  return x.value;
}

/// "ms" of "time [ms]", "time (ms)" and "t_ms"; "rad/s" of "speed_rad_s". Empty where there is none.
std::string unit_in(std::string_view heading) {
  const std::size_t open = heading.find_last_of("[(");
  std::string unit;
  if (open != std::string_view::npos && (heading.back() == ']' || heading.back() == ')')) {
    unit = heading.substr(open + 1, heading.size() - open - 2);
  } else {
    unit = heading.substr(without_unit(heading).size());
    if (!unit.empty()) unit.erase(0, 1);
    std::replace(unit.begin(), unit.end(), '_', '/');
  }
  return unit_of(unit) ? unit : std::string();
}

/// What the first column is: its unit, and how messages speak of it.
struct FirstColumn {
  const char *unit, *word, *row;
};
constexpr FirstColumn first_is_time{"s", "time", "a time in s and a value"},
    angle_column{"deg", "angle", "an angle in degrees and a value"};

class RowsReader {
 public:
  RowsReader(const std::string& name, const FirstColumn& first, const std::optional<std::string>& column,
             const std::string& unit)
      : name_(name), first_(first), column_(column), value_{unit, {}} {}

  void line(std::string_view text) {
    ++number_;
    const std::string_view content = bare_cell(text);
    if (content.empty() || content.front() == '#') return;
    if (separator_ == 0) separator_ = separator_of(content);
    const std::vector<std::string_view> cells = cells_of(content, separator_);
    const bool first = !begun_;
    begun_ = true;
    if (first && !number_of(cells.at(0), separator_))
      headings({cells.begin(), cells.end()});
    else if (first && column_)
      say("has no headings", fmt::format("the first line must name \"{}\"", *column_));
    else
      row(cells);
  }

  base::Result<ReferenceRows> result() {
    if (rows_.times_s.empty() && told_.empty())
      say("holds no row of numbers", fmt::format("give rows of {} and value", first_.word));
    if (skipped_ > 0)
      told_.push_back({.where = name_ + ":",
                       .limit = fmt::format("is wrong in {} more lines", skipped_),
                       .cure = fmt::format("each row is {}", first_.row)});
    if (!told_.empty()) return told_;
    return std::move(rows_);
  }

 private:
  /// What a column is wanted in, and what its heading says; empty: nothing, which is taken for the same.
  struct Column {
    std::string wanted, written;
  };

  void units(const std::vector<std::string>& names) {
    const auto take = [&](std::size_t at, Column& column) {
      if (at >= names.size()) return;
      column.written = unit_in(names[at]);
      if (column.written.empty() || column.written == column.wanted) return column.written.clear();
      if (same_kind(*unit_of(column.written), *unit_of(column.wanted))) return;
      say(fmt::format("heads a column in {}, where {} belongs", std::exchange(column.written, ""),
                      column.wanted.empty() ? "a plain number" : column.wanted),
          column.wanted.empty() ? "name another column" : "units that fit: " + units_that_fit(column.wanted));
    };
    take(0, time_);
    take(value_at_, value_);
  }

  void headings(const std::vector<std::string>& names) {
    if (!column_) return units(names);
    const auto found = std::find(names.begin(), names.end(), *column_);
    if (found != names.end()) {
      value_at_ = static_cast<std::size_t>(found - names.begin());
      return units(names);
    }
    const std::string near = nearest(*column_, names);
    say(fmt::format("has no column \"{}\"", *column_), near.empty()
                                                           ? fmt::format("it has {}", fmt::join(names, ", "))
                                                           : fmt::format("did you mean \"{}\"?", near));
  }

  std::optional<double> value_of(std::string_view cell, const Column& column) const {
    const std::optional<double> x = number_of(cell, separator_);
    if (!x || column.written.empty()) return x;
    std::string decimal(cell);
    if (separator_ == ';') std::replace(decimal.begin(), decimal.end(), ',', '.');
    const base::Result<double> converted = in_unit(decimal + " " + column.written, column.wanted);
    return converted ? std::optional(*converted) : std::nullopt;
  }

  void row(const std::vector<std::string_view>& cells) {
    if (cells.size() <= value_at_)
      return say(fmt::format("has {} cells", cells.size()), fmt::format("each row is {}", first_.row));
    const std::optional<double> t = value_of(cells[0], time_), y = value_of(cells[value_at_], value_);
    if (!t || !y)
      return say(fmt::format("\"{}\" is no number", cells[t ? value_at_ : 0]),
                 "write numbers as 0.5 or 5e-1");
    if (!allowed(*t, time_, cells[0]) || !allowed(*y, value_, cells[value_at_])) return;
    const double at = not_nearly(*t);
    const bool rises = rows_.times_s.empty() ? at >= 0.0 : at > rows_.times_s.back();
    if (!rises)
      return say(fmt::format("{} {} does not rise", first_.word, cells[0]),
                 fmt::format("sort the rows, from 0 {} on", first_.unit));
    rows_.times_s.push_back(at);
    rows_.values.push_back(not_nearly(*y));
  }

  bool allowed(double x, const Column& column, std::string_view cell) {
    base::Range range = base::allowed(base::Range{}, column.wanted);
    range.least = 0.0;
    if (range.holds(x)) return true;
    const std::string in = column.wanted.empty() ? "" : ", in " + column.wanted;
    say(fmt::format("\"{}\" {}{}", cell, limit_of(range), in), "look at the unit of its column");
    return false;
  }

  /// A trace that was recorded fades for ever: what is nearly nothing is 0.
  static double not_nearly(double x) { return std::fabs(x) < base::nearly_nothing ? 0.0 : x; }

  void say(std::string limit, std::string cure) {
    if (told_.size() < most_told)
      told_.push_back(bounded({.where = fmt::format("{}:{}:", name_, std::max<std::size_t>(number_, 1)),
                               .value = {},
                               .limit = std::move(limit),
                               .cure = std::move(cure)}));
    else
      ++skipped_;
  }

  const std::string& name_;
  const FirstColumn& first_;
  const std::optional<std::string>& column_;
  Column time_{first_.unit, {}}, value_;
  char separator_ = 0;
  bool begun_ = false;
  std::size_t number_ = 0, value_at_ = 1, skipped_ = 0;
  ReferenceRows rows_;
  base::Problems told_;
};

}  // namespace

namespace {

base::Result<ReferenceRows> read_lines(RowsReader reader, std::string_view rest) {
  if (rest.starts_with("\xef\xbb\xbf")) rest.remove_prefix(3);  // some editors begin a file with it
  while (!rest.empty()) {
    const std::size_t end = std::min(rest.find('\n'), rest.size());
    reader.line(rest.substr(0, end));
    rest.remove_prefix(std::min(end + 1, rest.size()));
  }
  return reader.result();
}

}  // namespace

base::Result<ReferenceRows> reference_rows(const std::string& name, const std::string& text,
                                           const std::optional<std::string>& column,
                                           const std::string& unit) {
  return read_lines(RowsReader(name, first_is_time, column, unit), text);
}

base::Result<ShapeRows> shape_rows(const std::string& name, const std::string& text) {
  const std::optional<std::string> second;
  base::Result<ReferenceRows> rows = read_lines(RowsReader(name, angle_column, second, ""), text);
  if (!rows) return rows.problems();
  return ShapeRows{std::move(rows->times_s), std::move(rows->values)};
}

}  // namespace text

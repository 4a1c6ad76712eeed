// SPDX-License-Identifier: Apache-2.0
#include "text/recording/recording.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <limits>
#include <utility>

#include "text/keys/bounded.hpp"
#include "text/keys/key_advice.hpp"
#include "text/keys/units.hpp"
#include "text/recording/recording_reader.hpp"

namespace text {
namespace {

/// Oscilloscopes write their settings there.
constexpr std::size_t most_heading_lines = 100;
/// 160 MB of them; no oscilloscope's memory that a bench needs is larger.
constexpr std::size_t most_values = 20'000'000;

/// `what` stands there, and `limit` says of it what is wrong.
base::Problem at_line(const std::string& name, std::size_t line, const std::string& what,
                      const std::string& limit, std::string cure) {
  return bounded({.where = line > 0 ? fmt::format("{}:{}:", name, line) : name + ":",
                  .value = "",
                  .limit = what.empty() ? limit : bounded(what, 400) + " " + limit,
                  .cure = std::move(cure)});
}

/// A heading, as messages and results quote it.
constexpr std::size_t longest_name = 80;

/// Bytes that no text has.
bool is_binary(std::string_view text) {
  constexpr std::size_t looked_at = 1 << 16;
  return text.substr(0, looked_at).find('\0') != std::string_view::npos;
}

bool is_remark(std::string_view line) {
  const std::size_t first = line.find_first_not_of(" \t\r");
  return first == std::string_view::npos || line[first] == '#' || line[first] == '%';
}

class Reader {
 public:
  explicit Reader(const std::string& name) { out_.name = name; }

  /// False where there is no sense in going on.
  bool line(std::string_view text) {
    ++number_;
    if (is_remark(text)) return true;
    if (separator_ == 0 && !begins_rows(text)) {
      headings_.emplace_back(text);
      return headings_.size() <= most_heading_lines;
    }
    row(text);
    return values_ <= most_values;
  }

  base::Result<Recording> result() {
    if (values_ > most_values)
      return at_line(out_.name, number_, "",
                     fmt::format("brings more than {} million values", most_values / 1'000'000),
                     "cut the recording, leave columns out, or keep every tenth row");
    if (out_.columns.empty() || out_.rows() == 0)
      return at_line(out_.name, number_ > 1 ? 0 : number_, "", "holds no row of numbers",
                     "export the recording as text: headings, then rows of numbers parted by commas");
    return std::move(out_);
  }

 private:
  /// A line whose first cell and most others are numbers.
  bool begins_rows(std::string_view text) {
    const char separator = separator_of_line(text);
    const std::vector<std::string_view> cells = cells_of_line(text, separator);
    if (cells.empty() || !number_in(cells[0], separator)) return false;
    separator_ = separator;
    out_.first_line = number_;
    name_columns(cells.size());
    return true;
  }

  /// From the last lines above the rows: headings, perhaps with a line of units below them.
  void name_columns(std::size_t count) {
    std::vector<std::string_view> units, names;
    for (std::size_t n = headings_.size(); n-- > 0 && names.empty();) {
      const std::vector<std::string_view> cells = cells_of_line(headings_[n], separator_);
      const bool all_units =
          !cells.empty() && std::all_of(cells.begin(), cells.end(),
                                        [](std::string_view cell) { return !unit_in_words(cell).empty(); });
      if (all_units && units.empty())
        units = cells;
      else if (cells.size() > 1 || count == 1)
        names = cells;
      else
        break;
    }
    if (names.empty())
      names = std::exchange(units, {});  // "s,V": units at once, or names that look like them
    for (std::size_t n = 0; n < count; ++n) {
      Heading heading = n < names.size() ? heading_of(names[n]) : Heading{};
      heading.name = bounded(std::move(heading.name), longest_name);
      if (heading.name.empty()) heading.name = fmt::format("column {}", n + 1);
      if (n < units.size()) heading.unit = unit_in_words(units[n]);
      out_.columns.push_back({std::move(heading.name), std::move(heading.unit), {}, 0, {}});
    }
  }

  void row(std::string_view text) {
    const std::vector<std::string_view> cells = cells_of_line(text, separator_);
    for (std::size_t n = 0; n < out_.columns.size(); ++n) {
      RecordedColumn& column = out_.columns[n];
      const std::string_view cell = n < cells.size() ? cells[n] : std::string_view();
      const std::optional<double> x = number_in(cell, separator_);
      if (!x && column.wrong_line == 0) {
        column.wrong_line = number_;
        column.wrong_cell = cell.substr(0, 200);
      }
      column.values.push_back(x.value_or(std::numeric_limits<double>::quiet_NaN()));
      ++values_;
    }
  }

  Recording out_;
  std::vector<std::string> headings_;
  char separator_ = 0;
  std::size_t number_ = 0, values_ = 0;
};

}  // namespace

base::Result<Recording> read_recording(const std::string& name, std::string_view text) {
  if (text.find_first_not_of(" \t\r\n") == std::string_view::npos)
    return at_line(name, 0, "", "is empty", "export the recording again: headings, then rows of numbers");
  if (is_binary(text))
    return at_line(name, 0, "", "is no text", "export the recording as CSV; gzip -d unpacks a .gz");
  if (text.starts_with("\xef\xbb\xbf")) text.remove_prefix(3);  // some programs begin a file with it
  Reader reader(name);
  while (!text.empty()) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    if (!reader.line(text.substr(0, end))) break;
    text.remove_prefix(std::min(end + 1, text.size()));
  }
  return reader.result();
}

std::string bare_name(std::string_view heading) {
  std::string out;
  for (const char c : heading)
    if (std::isalnum(static_cast<unsigned char>(c)) != 0)
      out += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return out;
}

const RecordedColumn* find_column(const Recording& recording, std::initializer_list<std::string_view> names) {
  for (const RecordedColumn& column : recording.columns)
    if (std::find(names.begin(), names.end(), bare_name(column.name)) != names.end()) return &column;
  return nullptr;
}

std::string headings_of(const Recording& recording) {
  constexpr std::size_t shown = 12;
  std::string out;
  for (std::size_t n = 0; n < recording.columns.size() && n < shown; ++n)
    out += (n == 0 ? "" : ", ") + recording.columns[n].name;
  return recording.columns.size() > shown
             ? out + fmt::format(" and {} more", recording.columns.size() - shown)
             : out;
}

base::Result<const RecordedColumn*> column_called(const Recording& recording, const std::string& heading) {
  std::vector<std::string> known;
  for (const RecordedColumn& column : recording.columns) {
    if (column.name == heading || bare_name(column.name) == bare_name(heading)) return &column;
    known.push_back(column.name);
  }
  const std::string near = nearest(heading, known);
  return at_line(
      recording.name, 0, "", fmt::format("has no column \"{}\"", heading),
      near.empty() ? "it has " + headings_of(recording) : fmt::format("did you mean \"{}\"?", near));
}

base::Result<std::vector<double>> values_of(const Recording& recording, const RecordedColumn& column,
                                            std::string_view unit) {
  if (column.wrong_line > 0)
    return at_line(recording.name, column.wrong_line,
                   fmt::format("{} \"{}\"", column.name, column.wrong_cell), "is no number",
                   "leave such rows out, and write numbers as 0.5 or 5e-1");
  std::vector<double> out = column.values;
  if (!column.unit.empty() && !unit.empty()) {
    const std::optional<Unit> from = unit_of(column.unit), to = unit_of(unit);
    if (!same_kind(*from, *to))
      return at_line(recording.name, 0, "",
                     fmt::format("heads {} as {}, where {} belongs", column.name, column.unit, unit),
                     fmt::format("name another column; units that fit: {}", units_that_fit(unit)));
    double factor = from->factor / to->factor;
    for (int n = 0; n < std::abs(from->ten - to->ten); ++n)
      factor = from->ten > to->ten ? factor * 10.0 : factor / 10.0;
    if (factor != 1.0)
      for (double& x : out) x *= factor;
  }
  constexpr double most = 1e12;  // what no instrument shows, and what products of can still be numbers
  for (std::size_t n = 0; n < out.size(); ++n)
    if (!(std::fabs(out[n]) <= most))
      return at_line(recording.name, 0, fmt::format("{} {:g}", column.name, out[n]),
                     fmt::format("in row {} is beyond all instruments", n + 1),
                     "look at the unit of its column");
  return out;
}

const RecordedColumn* time_column(const Recording& recording) {
  if (const RecordedColumn* named =
          find_column(recording, {"t", "time", "times", "ts", "timestamp", "seconds", "xaxis", "x"}))
    return named;
  for (const RecordedColumn& c : recording.columns)
    if (!c.unit.empty() && same_kind(*unit_of(c.unit), *unit_of("s"))) return &c;
  const bool bare = recording.columns.size() > 1 && recording.columns.front().name == "column 1";
  return bare ? &recording.columns.front() : nullptr;
}

namespace {

/// 0, 1, 2 or 1, 2, 3: as an oscilloscope numbers its samples.
bool are_numbers_of_rows(const std::vector<double>& values) {
  for (std::size_t n = 0; n < values.size(); ++n)
    if (values[n] - values[0] != static_cast<double>(n)) return false;
  return values.size() > 2;
}

}  // namespace

base::Result<std::vector<double>> times_of(const Recording& recording, std::optional<double> interval_s) {
  if (interval_s) {
    std::vector<double> out(recording.rows());
    for (std::size_t n = 0; n < out.size(); ++n) out[n] = static_cast<double>(n) * *interval_s;
    return out;
  }
  const RecordedColumn* const column = time_column(recording);
  if (!column)
    return at_line(recording.name, 0, "", "has no column of time: it has " + headings_of(recording),
                   "head it time [s], or give the interval of the rows");
  base::Result<std::vector<double>> times = values_of(recording, *column, "s");
  if (!times) return times;
  if (column->unit.empty() && are_numbers_of_rows(*times))
    return at_line(recording.name, 0, "", fmt::format("numbers its rows in {}", column->name),
                   "head the column time [s] where these are seconds, or give the interval of the rows");
  for (std::size_t n = 1; n < times->size(); ++n)
    if (!((*times)[n] > (*times)[n - 1]))
      return at_line(
          recording.name, 0, fmt::format("{} {:.10g}", column->name, (*times)[n]),
          fmt::format("in row {} does not rise", n + 1),
          "give the rows in the order of recording, with all digits of the time, or the interval of the rows");
  return times;
}

}  // namespace text

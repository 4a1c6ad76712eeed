// SPDX-License-Identifier: Apache-2.0
#include "text/recording/bench_recordings.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "text/keys/units.hpp"
#include "text/recording/bench_columns.hpp"
#include "text/recording/columns.hpp"
#include "text/recording/heading.hpp"
#include "text/recording/times.hpp"

namespace text {
namespace {

Meaning meaning_of_first(const Columns& columns) {
  return columns.empty() ? Meaning::unknown : meaning_of(*columns.front().column);
}

/// The points between which the voltages were measured, according to their headings.
std::optional<analysis::EmfBetween> between_in(const Columns& columns) {
  const Meaning meaning = meaning_of_first(columns);
  const bool alike = std::all_of(columns.begin(), columns.end(),
                                 [&](const Picked& p) { return meaning_of(*p.column) == meaning; });
  if (alike && meaning == Meaning::between_terminals) return analysis::EmfBetween::lines;
  if (alike && meaning == Meaning::of_terminal) return analysis::EmfBetween::star;
  return {};
}

/// The voltages that the options name, else the voltages that the headings identify. `taken` selects them: a
/// log of Hall lines needs the first two of three voltages, a back-EMF any of them.
base::Result<Voltages> voltages_of(const Recording& r, const BenchColumns& wanted,
                                   Columns (*taken)(const Three&)) {
  if (!wanted.voltages.empty()) {
    base::Result<Columns> named = columns_called(r, wanted.voltages);
    if (!named) return named.problems();
    const std::optional<analysis::EmfBetween> between = wanted.between ? wanted.between : between_in(*named);
    return Voltages{std::move(*named), between};
  }
  const base::Result<Three> lines = three_of(r, names_between_terminals());
  if (!lines) return lines.problems();
  const base::Result<Three> terminals = three_of(r, names_of_terminals());
  if (!terminals) return terminals.problems();
  return chosen(taken(*lines), taken(*terminals), wanted.between);
}

bool is_of_kind(const RecordedColumn& column, std::string_view unit) {
  return !column.unit.empty() && same_kind(*unit_of(column.unit), *unit_of(unit));
}

/// Whether a column is another time: some exporters write a column of time for each channel.
bool is_other_time(const RecordedColumn& column, const RecordedColumn* time) {
  if (&column == time || !time || !column.filled) return false;
  const bool same_heading = !time->heading.empty() && column.heading == time->heading;
  return same_heading || is_of_kind(column, "s");
}

/// Refuses channels that were sampled at different instants, because their values cannot be in one row.
base::Problems check_other_times(const Recording& r, const RecordedColumn* time) {
  for (const RecordedColumn& column : r.columns) {
    if (!is_other_time(column, time)) continue;
    for (std::size_t n = 0; n < r.rows(); ++n) {
      const double step = n > 0 ? std::fabs(time->values[n] - time->values[n - 1]) : 0.0;
      if (std::fabs(column.values[n] - time->values[n]) <= 0.01 * step + 1e-12) continue;
      return {of_recording(
          r, fmt::format("has two times: {} and {} differ in line {}", time->name, column.name, r.line_of(n)),
          "export all channels with one common time, or each channel to its own file")};
    }
  }
  return {};
}

bool is_among(const Columns& columns, const RecordedColumn& column) {
  return std::any_of(columns.begin(), columns.end(), [&](const Picked& p) { return p.column == &column; });
}

/// Notes each unused column with the reason. Called only if the options do not name the columns.
void note_rest(const Recording& r, const Columns& used, const RecordedColumn* time, const BenchUse& use,
               Notes& notes) {
  std::vector<NotUsed> rest;
  for (const RecordedColumn& column : r.columns) {
    if (&column == time || !column.filled || is_among(used, column)) continue;
    if (is_other_time(column, time)) continue;
    rest.push_back({column.name, column.has_numbers() ? why_not_used(column, use) : "holds no numbers"});
  }
  note_not_used(rest, notes);
}

/// Voltages with a heading such as "CH1" or without headings: all columns of numbers except times, Hall lines
/// and columns with the unit of another quantity.
Columns whatever_is_a_voltage(const Recording& r, const RecordedColumn* time, Notes& notes) {
  Columns out;
  std::vector<NotUsed> rest;
  for (const RecordedColumn& column : r.columns) {
    if (&column == time || !column.filled || is_other_time(column, time)) continue;
    if (!column.has_numbers())
      rest.push_back({column.name, "holds no numbers"});
    else if (is_of_other_unit(column) || meaning_of(column) != Meaning::unknown)
      rest.push_back({column.name, why_not_used(column, {})});
    else if (out.size() == analysis::most_emf_channels)
      rest.push_back({column.name, fmt::format("more than {} voltages", analysis::most_emf_channels)});
    else
      out.push_back({&column, column.unit});
  }
  note_not_used(rest, notes);
  return out;
}

/// The two voltage levels of a line.
struct Levels {
  double low = 0.0, high = 1.0;
};
Levels levels_of(std::vector<double> values) {
  // Quantiles instead of extremes, because spikes beyond the levels are rare.
  const auto at = [&](double part) {
    const auto place =
        values.begin() + static_cast<std::ptrdiff_t>(part * static_cast<double>(values.size() - 1));
    std::nth_element(values.begin(), place, values.end());
    return *place;
  };
  return {at(0.02), at(0.98)};
}

/// The line as high (true) and low (false).
std::vector<bool> digital(const std::vector<double>& values) {
  std::vector<bool> out(values.size());
  const bool is_digital =
      std::all_of(values.begin(), values.end(), [](double x) { return x == 0.0 || x == 1.0; });
  const Levels levels = is_digital ? Levels{} : levels_of(values);
  const double middle = 0.5 * (levels.low + levels.high), way = 0.15 * (levels.high - levels.low);
  bool high = !values.empty() && values.front() > middle;
  for (std::size_t n = 0; n < values.size(); ++n) {
    if (values[n] > middle + way) high = true;
    if (values[n] < middle - way) high = false;
    out[n] = high;
  }
  return out;
}

using Codes = std::vector<std::uint8_t>;

base::Result<Codes> codes_of(const Recording& r, const Picked& picked) {
  const base::Result<std::vector<double>> values = values_of(r, picked, "");
  if (!values) return values.problems();
  Codes out;
  for (std::size_t n = 0; n < values->size(); ++n) {
    const double x = (*values)[n];
    if (!(x >= 0.0 && x <= 7.0 && x == std::floor(x)))
      return of_recording(
          r, fmt::format("{} {:g} in row {} is not a Hall code, 0 to 7", picked.column->name, x, n + 1),
          "compute the code as 4 H1 + 2 H2 + H3, or give three columns hall1, hall2, hall3");
    out.push_back(static_cast<std::uint8_t>(x));
  }
  return out;
}

base::Result<Codes> codes_of(const Recording& r, const Columns& lines) {
  Codes out(r.rows());
  for (const Picked& line : lines) {
    const base::Result<std::vector<double>> values = values_of(r, line, line.unit.empty() ? "" : "V");
    if (!values) return values.problems();
    const std::vector<bool> high = digital(*values);
    for (std::size_t n = 0; n < out.size(); ++n)
      out[n] = static_cast<std::uint8_t>(out[n] << 1 | static_cast<unsigned>(high[n]));
  }
  return out;
}

/// The columns that the options name, else the columns that the headings identify. Three columns that a logic
/// analyzer heads "logic" are Hall lines.
base::Result<Columns> hall_columns(const Recording& r, const BenchColumns& wanted, Notes& notes) {
  if (!wanted.hall.empty()) return columns_called(r, wanted.hall);
  const base::Result<Three> three = three_of(r, names_of_hall_lines());
  if (!three) return three.problems();
  if (Columns lines = from_the_first(*three); lines.size() == 3) return lines;
  const base::Result<Picked> code = find_column(r, names_of_hall_codes());
  if (!code) return code.problems();
  if (code->column) return Columns{*code};
  Columns logic;
  for (const RecordedColumn& column : r.columns)
    if (bare_name(column.heading) == "logic") logic.push_back({&column, ""});
  if (logic.size() != 3) return Columns{};
  notes.push_back(fmt::format("the columns {}, {} and {} are read as H1, H2 and H3 in this order",
                              logic[0].column->name, logic[1].column->name, logic[2].column->name));
  return logic;
}

base::Result<Codes> hall_codes(const Recording& r, const Columns& columns) {
  if (columns.size() == 1) return codes_of(r, columns[0]);
  if (columns.size() == 3) return codes_of(r, columns);
  const char* lacks = columns.empty() ? "has no columns of Hall lines: it has "
                                      : "does not have three columns of Hall lines: it has ";
  return of_recording(
      r, lacks + headings_of(r),
      "write the headings hall1, hall2 and hall3, or hall above a column of codes, or name the columns with --hall");
}

/// The points between which a log's voltages were measured: as requested, else according to the headings. The
/// number of columns does not decide this.
base::Result<analysis::EmfBetween> between_of(const Voltages& voltages) {
  if (voltages.between) return *voltages.between;
  if (const std::optional<analysis::EmfBetween> said = between_in(voltages.columns)) return *said;
  return base::Problem{
      .where = "between",
      .value = "",
      .limit = "is missing, and the headings do not tell between which points the voltages were measured",
      .cure = "give lines for two terminals, or star for a terminal and any common point"};
}

base::Problems take_voltages(const Recording& r, const Voltages& voltages, const Times& times,
                             analysis::HallLog& out) {
  const std::size_t count = voltages.columns.size();
  const base::Result<analysis::EmfBetween> between = between_of(voltages);
  if (!between) return between.problems();
  const bool lines = *between == analysis::EmfBetween::lines;
  if (count > 3 || count < (lines ? 2U : 3U))
    return {of_recording(r,
                         fmt::format("has {} {} of {}", count, count == 1 ? "voltage" : "voltages",
                                     lines ? "lines" : "terminals"),
                         lines ? "give u_ab and u_bc, or remove the voltages to use only the Hall codes"
                               : "give u_a, u_b and u_c, or remove the voltages to use only the Hall codes")};
  out.voltages = lines ? analysis::RecordedVoltages::lines : analysis::RecordedVoltages::terminals;
  for (std::size_t n = 0; n < count; ++n) {
    base::Result<std::vector<double>> values = values_of(r, voltages.columns[n], "V");
    if (!values) return values.problems();
    out.u_V[n] = without_rows(std::move(*values), times.left_out);
  }
  return {};
}

}  // namespace

base::Result<analysis::HallLog> hall_log_of(const Recording& r, const BenchColumns& wanted, Notes& notes) {
  analysis::HallLog out;
  const base::Result<Columns> lines = hall_columns(r, wanted, notes);
  if (!lines) return lines.problems();
  base::Result<Codes> codes = hall_codes(r, *lines);
  if (!codes) return codes.problems();
  base::Result<Times> times = times_of(r, wanted.interval_s, notes);
  if (!times) return times.problems();
  if (base::Problems wrong = check_other_times(r, times->column); !wrong.empty()) return wrong;
  const base::Result<Voltages> voltages = voltages_of(r, wanted, from_the_first);
  if (!voltages) return voltages.problems();
  out.codes = without_rows(std::move(*codes), times->left_out);
  if (!voltages->columns.empty())
    if (base::Problems wrong = take_voltages(r, *voltages, *times, out); !wrong.empty()) return wrong;
  out.t_s = std::move(times->t_s);
  Columns used = *lines;
  used.insert(used.end(), voltages->columns.begin(), voltages->columns.end());
  const BenchUse use{true, lines->size() == 1, !wanted.voltages.empty(), meaning_of_first(voltages->columns)};
  if (wanted.hall.empty()) note_rest(r, used, times->column, use, notes);
  return out;
}

base::Result<analysis::EmfRecord> emf_record_of(const Recording& r, const BenchColumns& wanted,
                                                Notes& notes) {
  analysis::EmfRecord out;
  base::Result<Times> times = times_of(r, wanted.interval_s, notes);
  if (!times) return times.problems();
  if (base::Problems wrong = check_other_times(r, times->column); !wrong.empty()) return wrong;
  base::Result<Voltages> voltages = voltages_of(r, wanted, in_turn);
  if (!voltages) return voltages.problems();
  if (voltages->columns.empty())
    voltages = Voltages{whatever_is_a_voltage(r, times->column, notes), wanted.between};
  else if (wanted.voltages.empty())
    note_rest(r, voltages->columns, times->column, {false, false, false, meaning_of_first(voltages->columns)},
              notes);
  if (voltages->columns.empty())
    return of_recording(r, "has no column of voltages: it has " + headings_of(r),
                        "name the columns of the voltages with --voltages");
  if (!voltages->between)
    return base::Problem{
        .where = "between",
        .value = "",
        .limit = "is missing, and the headings do not tell between which points the voltages were measured",
        .cure = "give lines for two terminals, or star for a terminal and the star point"};
  out.between = *voltages->between;
  out.t_s = std::move(times->t_s);
  for (const Picked& picked : voltages->columns) {
    base::Result<std::vector<double>> values = values_of(r, picked, "V");
    if (!values) return values.problems();
    out.channels.push_back({picked.column->name, without_rows(std::move(*values), times->left_out)});
  }
  return out;
}

}  // namespace text

// SPDX-License-Identifier: Apache-2.0
#include "text/recording/bench_recordings.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "text/keys/bounded.hpp"

namespace text {
namespace {

using Columns = std::vector<const RecordedColumn*>;
using Names = std::initializer_list<std::string_view>;

base::Problem problem(const Recording& recording, std::string limit, std::string cure) {
  return bounded(
      {.where = recording.name + ":", .value = "", .limit = std::move(limit), .cure = std::move(cure)});
}

base::Result<Columns> columns_called(const Recording& recording, const std::vector<std::string>& headings) {
  Columns out;
  for (const std::string& heading : headings) {
    const base::Result<const RecordedColumn*> column = column_called(recording, heading);
    if (!column) return column.problems();
    out.push_back(*column);
  }
  return out;
}

/// All of them, or as many as come before the first that is missing.
Columns columns_like(const Recording& recording, std::initializer_list<Names> wanted) {
  Columns out;
  for (const Names names : wanted) {
    const RecordedColumn* const column = find_column(recording, names);
    if (!column) break;
    out.push_back(column);
  }
  return out;
}

Columns line_voltages(const Recording& r) {
  return columns_like(
      r, {{"uab", "vab", "eab", "ab"}, {"ubc", "vbc", "ebc", "bc"}, {"uca", "vca", "eca", "ca"}});
}
Columns terminal_voltages(const Recording& r) {
  return columns_like(r, {{"ua", "va", "ea", "phasea", "vphasea"},
                          {"ub", "vb", "eb", "phaseb", "vphaseb"},
                          {"uc", "vc", "ec", "phasec", "vphasec"}});
}

struct Voltages {
  Columns columns;
  std::optional<analysis::EmfBetween> between;
};

/// By the options, else by the headings: between lines, where both are there.
base::Result<Voltages> voltages_of(const Recording& r, const BenchColumns& wanted) {
  if (!wanted.voltages.empty()) {
    base::Result<Columns> named = columns_called(r, wanted.voltages);
    if (!named) return named.problems();
    return Voltages{std::move(*named), wanted.between};
  }
  const Columns lines = line_voltages(r), terminals = terminal_voltages(r);
  const bool star = wanted.between == analysis::EmfBetween::star;
  if (lines.size() > 1 && !star) return Voltages{lines, analysis::EmfBetween::lines};
  if (terminals.size() == 3) return Voltages{terminals, wanted.between.value_or(analysis::EmfBetween::star)};
  if (!lines.empty()) return Voltages{lines, wanted.between.value_or(analysis::EmfBetween::lines)};
  return Voltages{terminals, wanted.between};
}

/// Two levels of a line, or why it has none.
struct Levels {
  double low = 0.0, high = 1.0;
};
Levels levels_of(std::vector<double> values) {
  // Spikes beyond the levels are few.
  const auto at = [&](double part) {
    const auto place =
        values.begin() + static_cast<std::ptrdiff_t>(part * static_cast<double>(values.size() - 1));
    std::nth_element(values.begin(), place, values.end());
    return *place;
  };
  return {at(0.02), at(0.98)};
}

/// 1 where the line is high.
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

base::Result<std::vector<std::uint8_t>> codes_of(const Recording& r, const RecordedColumn& column) {
  const base::Result<std::vector<double>> values = values_of(r, column, "");
  if (!values) return values.problems();
  std::vector<std::uint8_t> out;
  for (std::size_t n = 0; n < values->size(); ++n) {
    const double x = (*values)[n];
    if (!(x >= 0.0 && x <= 7.0 && x == std::floor(x)))
      return base::Problem{
          .where = r.name + ":",
          .value = "",
          .limit = fmt::format("{} {:g} in row {} is no Hall code, 0 to 7", column.name, x, n + 1),
          .cure = "a code is 4 H1 + 2 H2 + H3; three lines of their own are columns hall1, hall2, hall3"};
    out.push_back(static_cast<std::uint8_t>(x));
  }
  return out;
}

base::Result<std::vector<std::uint8_t>> codes_of(const Recording& r, const Columns& lines) {
  std::vector<std::uint8_t> out(r.rows());
  for (const RecordedColumn* line : lines) {
    const base::Result<std::vector<double>> values = values_of(r, *line, line->unit.empty() ? "" : "V");
    if (!values) return values.problems();
    const std::vector<bool> high = digital(*values);
    for (std::size_t n = 0; n < out.size(); ++n)
      out[n] = static_cast<std::uint8_t>(out[n] << 1 | static_cast<unsigned>(high[n]));
  }
  return out;
}

base::Result<std::vector<std::uint8_t>> hall_codes(const Recording& r, const BenchColumns& wanted) {
  Columns lines;
  if (!wanted.hall.empty()) {
    const base::Result<Columns> named = columns_called(r, wanted.hall);
    if (!named) return named.problems();
    lines = *named;
  } else {
    lines = columns_like(r, {{"hall1", "h1", "halla", "ha", "hallu", "hu"},
                             {"hall2", "h2", "hallb", "hb", "hallv", "hv"},
                             {"hall3", "h3", "hallc", "hc", "hallw", "hw"}});
    if (lines.size() != 3) lines = columns_like(r, {{"hall", "code", "hallcode", "hallstate"}});
  }
  if (lines.size() == 1) return codes_of(r, *lines[0]);
  if (lines.size() == 3) return codes_of(r, lines);
  return problem(r, "has no columns of Hall lines: it has " + headings_of(r),
                 "head them hall1, hall2, hall3, or one of codes hall, or name the columns");
}

}  // namespace

base::Result<analysis::HallLog> hall_log_of(const Recording& r, const BenchColumns& wanted) {
  analysis::HallLog out;
  base::Result<std::vector<std::uint8_t>> codes = hall_codes(r, wanted);
  if (!codes) return codes.problems();
  base::Result<std::vector<double>> times = times_of(r, wanted.interval_s);
  if (!times) return times.problems();
  const base::Result<Voltages> voltages = voltages_of(r, wanted);
  if (!voltages) return voltages.problems();
  out.codes = std::move(*codes);
  out.t_s = std::move(*times);
  const std::size_t count = voltages->columns.size();
  if (count == 0) return out;
  const bool lines =
      voltages->between.value_or(count == 2 ? analysis::EmfBetween::lines : analysis::EmfBetween::star) ==
      analysis::EmfBetween::lines;
  if (count > 3 || count < (lines ? 2U : 3U))
    return problem(r,
                   fmt::format("has {} {} of {}", count, count == 1 ? "voltage" : "voltages",
                               lines ? "lines" : "terminals"),
                   lines ? "u_ab and u_bc are needed; leave out the voltages to go by the codes alone"
                         : "u_a, u_b and u_c are needed; leave out the voltages to go by the codes alone");
  out.voltages = lines ? analysis::RecordedVoltages::lines : analysis::RecordedVoltages::terminals;
  for (std::size_t n = 0; n < count; ++n) {
    base::Result<std::vector<double>> values = values_of(r, *voltages->columns[n], "V");
    if (!values) return values.problems();
    out.u_V[n] = std::move(*values);
  }
  return out;
}

base::Result<analysis::EmfRecord> emf_record_of(const Recording& r, const BenchColumns& wanted) {
  analysis::EmfRecord out;
  base::Result<std::vector<double>> times = times_of(r, wanted.interval_s);
  if (!times) return times.problems();
  base::Result<Voltages> voltages = voltages_of(r, wanted);
  if (!voltages) return voltages.problems();
  if (voltages->columns.empty()) {  // "CH1" or no heading at all: whatever is no time
    const RecordedColumn* const time = time_column(r);
    for (const RecordedColumn& column : r.columns)
      if (&column != time && column.wrong_line == 0 && voltages->columns.size() < analysis::most_emf_channels)
        voltages->columns.push_back(&column);
    voltages->between = wanted.between;
  }
  if (voltages->columns.empty())
    return problem(r, "has no column of voltages: it has " + headings_of(r), "name the columns");
  if (!voltages->between)
    return base::Problem{.where = "between",
                         .value = "",
                         .limit = "is missing: the headings do not say what the probes hung between",
                         .cure = "lines is two terminals, star a terminal and the star point"};
  out.between = *voltages->between;
  out.t_s = std::move(*times);
  for (const RecordedColumn* column : voltages->columns) {
    base::Result<std::vector<double>> values = values_of(r, *column, "V");
    if (!values) return values.problems();
    out.channels.push_back({column->name, std::move(*values)});
  }
  return out;
}

}  // namespace text

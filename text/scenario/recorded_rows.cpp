// SPDX-License-Identifier: Apache-2.0
#include "text/scenario/recorded_rows.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "sixstep/study/measure/columns.hpp"
#include "text/recording/board_log.hpp"

namespace text {
namespace {

/// Least difference of two values.
double step_of(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  double least = 0.0;
  for (std::size_t n = 1; n < values.size(); ++n)
    if (const double d = values[n] - values[n - 1]; d > 0.0 && (least == 0.0 || d < least)) least = d;
  return least;
}

/// The column that lies over the signal, with the interval of its rows.
base::Result<study::RecordedRows> rows_of(const NamedText& file, const study::LaidOver& laid,
                                          const std::string& column) {
  const study::Recording& c = laid.recording;
  LogColumns wanted;
  // A probe's numbers count as they stand; otherwise the heading's unit counts.
  if (!c.column.empty()) wanted.formulas = {column + "=" + (c.has_probe() ? "1*" : "") + c.column};
  base::Result<BoardLog> log = read_board_log(file.name, file.text, wanted);
  if (!log) return log.problems();
  const study::Trace& trace = log->trace;
  std::size_t n = 1;
  while (n < trace.columns.size() && trace.columns[n].name != column) ++n;
  const std::vector<double>& t = trace.values.front();
  const auto problem = [&](std::string limit, std::string cure) {
    return base::Problem{.where = file.name + ":", .limit = std::move(limit), .cure = std::move(cure)};
  };
  if (n == trace.columns.size())
    return problem(fmt::format("has no column of {}", column), "name the column with column = \"..\"");
  if (t.size() < study::fewest_rows)
    return problem(fmt::format("has {} rows, and {} are needed", t.size(), study::fewest_rows),
                   "record more");
  const double interval_s = (t.back() - t.front()) / static_cast<double>(t.size() - 1);
  for (std::size_t row = 0; row < t.size(); ++row)
    if (!(std::abs(t[row] - t.front() - interval_s * static_cast<double>(row)) <= 0.5 * interval_s))
      return problem(
          fmt::format("has rows that are not evenly spaced: row {} is at {:.9g} s", row + 1, t[row]),
          "record at a constant interval, or compare the log of a board with --compare");
  for (std::size_t row = 0; row < t.size(); ++row)
    if (!std::isfinite(trace.values[n][row]))
      return problem(fmt::format("has no number in row {}", row + 1), "keep the rows with numbers");
  return study::RecordedRows{interval_s, step_of(trace.values[n]), trace.values[n]};
}

void read_one(const Document& document, const Resolve& resolve, study::LaidOver& laid, Complaints& complaints,
              base::Problems& of_other_files) {
  const std::string key = fmt::format("compare[{}].file", laid.place);
  const toml::node* node = document.find(key);
  const std::optional<std::size_t> column = study::column_of(laid.measure.signal);
  if (!node || !column) return;
  const base::Result<NamedText> file =
      find_text(resolve, {Naming::Kind::rows, laid.recording.file, document.file_of(*node, key)});
  if (!file) {
    base::Problem problem = file.problems().front();
    problem.where = key;
    return complaints.later(std::move(problem));
  }
  base::Result<study::RecordedRows> rows = rows_of(*file, laid, study::all_columns()[*column].name);
  if (!rows) {
    append(of_other_files, rows.problems());
    return complaints.told_elsewhere(key);
  }
  laid.recording.rows = std::make_shared<const study::RecordedRows>(std::move(*rows));
}

/// Keys that act only with a file, or only without one.
void refuse_unused(const study::Comparison& c, const std::string& table, const Document& document,
                   Complaints& complaints) {
  constexpr const char* with_file[] = {
      "column",           "figures", "free",       "scale",     "offset",
      "shift_s",          "mean_s",  "shortest_s", "longest_s", "conditions_percent",
      "tolerance_percent"};
  constexpr const char* without[] = {"metric",   "value", "source", "start",
                                     "fraction", "band",  "tail",   "sampled"};
  const auto refuse = [&](const char* key, const char* limit, const char* cure) {
    const std::string path = table + "." + key;
    if (document.find(path)) complaints.later({.where = path, .limit = limit, .cure = cure});
  };
  if (c.recording->file.empty())
    for (const char* key : with_file) refuse(key, "has no effect without file", "name a recording with file");
  else
    for (const char* key : without) refuse(key, "has no effect with file", "remove it");
}

}  // namespace

void read_recordings(const Document& document, const Resolve& resolve, study::Scenario& scenario,
                     Complaints& complaints, base::Problems& of_other_files) {
  std::vector<study::LaidOver> found;
  for (std::size_t n = 0; n < scenario.compare.size(); ++n) {
    study::Comparison& c = scenario.compare[n];
    if (!c.recording) continue;
    refuse_unused(c, fmt::format("compare[{}]", n), document, complaints);
    if (c.recording->file.empty()) {
      c.recording.reset();
      continue;
    }
    read_one(document, resolve, found.emplace_back(study::LaidOver{c.measure, *c.recording, n}), complaints,
             of_other_files);
  }
  std::erase_if(scenario.compare, [](const study::Comparison& c) { return c.recording != nullptr; });
  if (!found.empty())
    scenario.laid_over = std::make_shared<const std::vector<study::LaidOver>>(std::move(found));
}

}  // namespace text

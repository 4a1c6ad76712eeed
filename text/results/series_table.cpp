// SPDX-License-Identifier: Apache-2.0
#include "text/results/series_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <vector>

#include "text/escape/escape.hpp"
#include "text/results/quantity_text.hpp"

namespace text {
namespace {

constexpr std::size_t columns = 10;
constexpr int digits = 4;  // a thousand drives do not tell more
using Row = std::array<std::string, columns>;

std::string cell(const std::optional<double>& x, const std::string& unit) {
  return x ? quantity_text(*x, unit, digits) : "-";
}

std::string required(const analysis::SpreadFigure& f) {
  if (f.min && f.max) return quantity_text(*f.min, f.unit) + " .. " + quantity_text(*f.max, f.unit);
  if (f.min) return ">= " + quantity_text(*f.min, f.unit);
  return f.max ? "<= " + quantity_text(*f.max, f.unit) : "";
}

Row row_of(const analysis::SpreadFigure& f, std::size_t runs) {
  const analysis::Statistics& s = f.statistics;
  return {"  " + f.figure,
          required(f),
          cell(s.min(), f.unit),
          cell(s.quantile(0.05), f.unit),
          cell(s.quantile(0.5), f.unit),
          cell(s.quantile(0.95), f.unit),
          cell(s.max(), f.unit),
          cell(s.mean(), f.unit),
          cell(s.standard_deviation(), f.unit),
          f.required ? fmt::format("{} of {}", f.holds, runs) : ""};
}

std::string aligned(std::vector<Row> rows) {
  for (Row& row : rows)
    for (std::string& cell : row) cell = visible(cell);
  std::array<std::size_t, columns> widths{};
  for (const Row& row : rows)
    for (std::size_t c = 0; c < columns; ++c) widths[c] = std::max(widths[c], row[c].size());
  std::string text;
  for (const Row& row : rows) {
    std::string line;
    for (std::size_t c = 0; c < columns; ++c)
      line += c < 2 ? fmt::format("{:<{}}  ", row[c], widths[c]) : fmt::format("{:>{}}  ", row[c], widths[c]);
    line.erase(line.find_last_not_of(' ') + 1);
    text += line + "\n";
  }
  return text;
}

std::string casualties(const std::vector<analysis::Casualty>& which, const char* what) {
  if (which.empty()) return "";
  return fmt::format("  {} {}, the first of them drive {}: {}\n", which.size(), what, which[0].number,
                     visible(to_string(which[0].problem)));
}

/// Of those that were run; what an interrupted series would have come to, nobody knows.
std::string sum(const analysis::Series& series, std::uint64_t seed, std::size_t wanted) {
  if (series.runs == 0) return fmt::format("interrupted before the first of {} drives ended\n", wanted);
  const bool all = series.runs == wanted;
  const std::string begin =
      all ? fmt::format("{} drives, seed {}: ", series.runs, seed)
          : fmt::format("interrupted after {} of {} drives, seed {}: ", series.runs, wanted, seed);
  const std::string of_these = all ? "" : "of these ";
  if (series.passed < series.runs)
    return begin + of_these +
           fmt::format("{} hold every requirement, {} do NOT\n", series.passed, series.runs - series.passed);
  const bool asks = std::any_of(series.figures.begin(), series.figures.end(),
                                [](const analysis::SpreadFigure& f) { return f.required; });
  return begin + (asks ? of_these + "all hold every requirement\n" : "nothing required\n");
}

}  // namespace

std::string series_table(const std::string& name, const analysis::Series& series, std::uint64_t seed,
                         std::size_t wanted) {
  if (series.runs == 0) return sum(series, seed, wanted);
  std::vector<Row> rows = {
      {name, "required", "min", "5 %", "median", "95 %", "max", "mean", "deviation", "holds"}};
  for (const analysis::SpreadFigure& figure : series.figures) rows.push_back(row_of(figure, series.runs));
  std::string text = aligned(std::move(rows));
  text += casualties(series.faults, "stopped by a fault");
  text += casualties(series.refused, "could not run");
  for (const analysis::SpreadFigure& f : series.figures)
    if (f.first_miss)
      text += fmt::format("  {}: the first miss is drive {} (--seed {} --drive {})\n", visible(f.figure),
                          *f.first_miss, seed, *f.first_miss);
  return text + sum(series, seed, wanted);
}

}  // namespace text

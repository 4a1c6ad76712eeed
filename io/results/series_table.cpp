// SPDX-License-Identifier: Apache-2.0
#include "io/results/series_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <vector>

#include "io/escape/escape.hpp"
#include "io/results/quantity_text.hpp"

namespace io {
namespace {

constexpr std::size_t columns = 10;
constexpr int digits = 4;  // a thousand drives do not tell more
using Row = std::array<std::string, columns>;

std::string cell(const std::optional<double>& x, const std::string& unit) {
  return x ? quantity_text(*x, unit, digits) : "-";
}

std::string required(const batch::SpreadFigure& f) {
  if (f.min && f.max) return quantity_text(*f.min, f.unit) + " .. " + quantity_text(*f.max, f.unit);
  if (f.min) return ">= " + quantity_text(*f.min, f.unit);
  return f.max ? "<= " + quantity_text(*f.max, f.unit) : "";
}

Row row_of(const batch::SpreadFigure& f, std::size_t runs) {
  const batch::Statistics& s = f.statistics;
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

std::string casualties(const std::vector<batch::Casualty>& which, const char* what) {
  if (which.empty()) return "";
  return fmt::format("  {} {}, the first of them drive {}: {}\n", which.size(), what, which[0].number,
                     visible(to_string(which[0].problem)));
}

}  // namespace

std::string series_table(const std::string& name, const batch::Series& series, std::uint64_t seed) {
  std::vector<Row> rows = {
      {name, "required", "min", "5 %", "median", "95 %", "max", "mean", "deviation", "holds"}};
  for (const batch::SpreadFigure& figure : series.figures) rows.push_back(row_of(figure, series.runs));
  std::string text = aligned(std::move(rows));
  text += casualties(series.faults, "stopped by a fault");
  text += casualties(series.refused, "could not run");
  for (const batch::SpreadFigure& f : series.figures)
    if (f.first_miss)
      text += fmt::format("  {}: the first miss is drive {} (--seed {} --drive {})\n", visible(f.figure),
                          *f.first_miss, seed, *f.first_miss);
  const bool asks = std::any_of(series.figures.begin(), series.figures.end(),
                                [](const batch::SpreadFigure& f) { return f.required; });
  text += fmt::format("{} drives, seed {}: ", series.runs, seed);
  if (!asks && series.passed == series.runs) return text + "nothing required\n";
  return text + (series.passed == series.runs ? "all hold every requirement\n"
                                              : fmt::format("{} hold every requirement, {} do NOT\n",
                                                            series.passed, series.runs - series.passed));
}

}  // namespace io

// SPDX-License-Identifier: Apache-2.0
#include "text/results/series_table.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <vector>

#include "text/escape/escape.hpp"
#include "text/results/quantity_text.hpp"

namespace text {
namespace {

constexpr std::size_t series_columns = 10;
constexpr int spread_digits = 4;  // a thousand drives do not give more significant digits
using SeriesRow = std::array<std::string, series_columns>;

std::string cell(const std::optional<double>& x, const SharedPrefix& prefix, int digits = spread_digits) {
  return x ? prefix.text(*x, digits) : "-";
}

std::string required(const analysis::FigureColumn& f) {
  if (f.min && f.max) return quantity_text(*f.min, f.unit) + " .. " + quantity_text(*f.max, f.unit);
  if (f.min) return ">= " + quantity_text(*f.min, f.unit);
  return f.max ? "<= " + quantity_text(*f.max, f.unit) : "";
}

/// The least margin in words: "0.3 ms beyond its limit", "12 mA within its limits".
std::string margin_text(const analysis::SpreadFigure& f) {
  if (!std::isfinite(f.least_margin)) return "without a finite value";
  return fmt::format("{} {} its limit{}",
                     quantity_text(std::fabs(f.least_margin), f.column.unit, spread_digits),
                     f.least_margin < 0.0 ? "beyond" : "within", f.column.min && f.column.max ? "s" : "");
}

/// The number of digits of a value at which its standard deviation has two digits.
int digits_of(const analysis::Statistics& s) {
  const std::optional<double> deviation = s.standard_deviation();
  if (!deviation || !(*deviation > 0.0)) return spread_digits;
  const double largest = std::max(std::fabs(*s.min()), std::fabs(*s.max()));
  return std::clamp(static_cast<int>(std::floor(std::log10(largest / *deviation))) + 2, spread_digits, 8);
}

SeriesRow row_of(const analysis::SpreadFigure& f, std::size_t runs) {
  const analysis::Statistics& s = f.statistics;
  const std::optional<double> numbers[] = {s.min(),          s.quantile(0.05), s.median(),
                                           s.quantile(0.95), s.max(),          s.mean()};
  std::vector<double> values;
  for (const std::optional<double>& x : numbers)
    if (x) values.push_back(*x);
  const SharedPrefix prefix(values, f.column.unit);
  const int digits = digits_of(s);
  SeriesRow row{"  " + f.column.name, required(f.column)};
  for (std::size_t n = 0; n < std::size(numbers); ++n) row[n + 2] = cell(numbers[n], prefix, digits);
  // A deviation is a difference, and may be much smaller.
  const std::optional<double> deviation = s.standard_deviation();
  row[8] = deviation ? quantity_text(*deviation, f.column.unit, spread_digits) : "-";
  row[9] = f.column.required ? fmt::format("{} of {}", f.holds, runs) : "";
  return row;
}

std::string aligned(std::vector<SeriesRow> rows) {
  for (SeriesRow& row : rows)
    for (std::string& cell : row) cell = visible(cell);
  std::array<std::size_t, series_columns> widths{};
  for (const SeriesRow& row : rows)
    for (std::size_t c = 0; c < series_columns; ++c) widths[c] = std::max(widths[c], row[c].size());
  std::string text;
  for (const SeriesRow& row : rows) {
    std::string line;
    for (std::size_t c = 0; c < series_columns; ++c)
      line += c < 2 ? fmt::format("{:<{}}  ", row[c], widths[c]) : fmt::format("{:>{}}  ", row[c], widths[c]);
    line.erase(line.find_last_not_of(' ') + 1);
    text += line + "\n";
  }
  return text;
}

/// The word for one run of a plan: "drive" in a series of drives, otherwise "run".
const char* one_of(const analysis::Plan& plan) { return plan.axes.empty() ? "drive" : "run"; }

std::string casualties(const std::vector<analysis::Casualty>& which, const char* what,
                       const analysis::Plan& plan) {
  if (which.empty()) return "";
  return fmt::format("  {} {}, first {} {}: {}\n", which.size(), what, one_of(plan), which[0].number,
                     visible(which[0].problem));
}

constexpr std::size_t most_numbers = 8;

/// The runs in words: "run 4", "runs 0, 1, 2", "all runs", or "12 runs, the first of them 4".
std::string those(const std::vector<std::size_t>& numbers, const analysis::Series& series,
                  const analysis::Plan& plan) {
  const char* one = one_of(plan);
  if (numbers.size() == series.runs && series.runs > 1) return fmt::format("all {}s", one);
  if (numbers.size() > most_numbers)
    return fmt::format("{} {}s, the first of them {}", numbers.size(), one, numbers.front());
  return fmt::format("{}{} {}", one, numbers.size() > 1 ? "s" : "", fmt::join(numbers, ", "));
}

/// Whether a fault stopped the run, which may be why it missed the requirement.
bool stopped(std::size_t number, const analysis::Series& series) {
  return std::any_of(series.faults.begin(), series.faults.end(),
                     [number](const analysis::Casualty& c) { return c.number == number; });
}

/// The requirement with the least margin if all requirements hold. The margin is relative to the limit, or to
/// half the distance between two limits. A temperature's limit counts from the ambient temperature on.
const analysis::SpreadFigure* closest_of(const analysis::Series& series) {
  const analysis::SpreadFigure* closest = nullptr;
  double least = 0.0;
  for (const analysis::SpreadFigure& f : series.figures) {
    if (!f.worst || (!f.column.min && !f.column.max)) continue;
    if (f.holds < series.runs) return nullptr;
    const double limit = f.column.min && f.column.max
                             ? (*f.column.max - *f.column.min) / 2
                             : f.column.size(f.column.min ? *f.column.min : *f.column.max);
    if (!(limit > 0.0) || (closest && f.least_margin / limit >= least)) continue;
    closest = &f;
    least = f.least_margin / limit;
  }
  return closest;
}

bool draws(const analysis::Plan& plan) {
  return plan.drives > 0 || plan.sampling != analysis::Sampling::grid;
}

}  // namespace

std::string series_sum(const analysis::Series& series, const analysis::Plan& plan) {
  const std::size_t wanted = analysis::runs_of(plan);
  const std::string all_of_them = fmt::format("{} {}s", wanted, one_of(plan));
  if (series.runs == 0) return fmt::format("interrupted before the first of {} ended\n", all_of_them);
  const bool all = series.runs == wanted;
  const std::string seed = draws(plan) ? fmt::format(", seed {}", plan.seed) : "";
  const std::string begin =
      all ? fmt::format("{}{}: ", all_of_them, seed)
          : fmt::format("interrupted after {} of {}{}: ", series.runs, all_of_them, seed);
  const std::string of_these = all ? "" : "of these ";
  if (series.passed < series.runs)
    return begin + of_these +
           fmt::format("{} hold every requirement, {} do NOT\n", series.passed, series.runs - series.passed);
  const bool asks = std::any_of(series.figures.begin(), series.figures.end(),
                                [](const analysis::SpreadFigure& f) { return f.column.required; });
  return begin + (asks ? of_these + "all hold every requirement\n" : "nothing required\n");
}

std::string repeats_text(const analysis::Plan& plan, std::size_t number) {
  return plan.axes.empty() ? fmt::format("--seed {} --drive {}", plan.seed, number)
                           : fmt::format("--only {}", number);
}

std::string stopped_text(const analysis::Series& series, const analysis::Plan& plan) {
  return casualties(series.faults, "stopped by a fault", plan) +
         casualties(series.refused, "could not run", plan);
}

std::string remarks_text(const analysis::Series& series, const analysis::Plan& plan) {
  std::string text;
  for (const analysis::SeriesRemark& r : series.remarks)
    text += fmt::format(
        "  remark, {}{}: {}\n", those(r.numbers, series, plan),
        r.differs ? fmt::format(" (with the numbers of {} {})", one_of(plan), r.numbers.front()) : "",
        visible(r.text));
  return text;
}

std::string casualties_text(const analysis::Series& series, const analysis::Plan& plan) {
  std::string text = stopped_text(series, plan);
  const analysis::SpreadFigure* const closest = closest_of(series);
  for (const analysis::SpreadFigure& f : series.figures)
    if (&f == closest || f.missed)
      text += fmt::format("  {}: {} {} {}{}, {} ({})\n", visible(f.column.name),
                          &f == closest ? "closest to its limit is" : "worst is", one_of(plan), *f.worst,
                          stopped(*f.worst, series) ? ", which a fault stopped" : "", margin_text(f),
                          repeats_text(plan, *f.worst));
  return text;
}

std::string series_table(const std::string& name, const analysis::Series& series,
                         const analysis::Plan& plan) {
  if (series.runs == 0) return series_sum(series, plan);
  std::vector<SeriesRow> rows = {
      {name, "required", "min", "5 %", "median", "95 %", "max", "mean", "std. dev.", "holds"}};
  for (const analysis::SpreadFigure& figure : series.figures) rows.push_back(row_of(figure, series.runs));
  return aligned(std::move(rows)) + casualties_text(series, plan) + remarks_text(series, plan) +
         series_sum(series, plan);
}

}  // namespace text

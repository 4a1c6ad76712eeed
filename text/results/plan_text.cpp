// SPDX-License-Identifier: Apache-2.0
#include "text/results/plan_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "sixstep/base/written.hpp"
#include "text/escape/escape.hpp"
#include "text/keys/decimal_number.hpp"
#include "text/results/quantity_text.hpp"
#include "text/results/series_table.hpp"
#include "text/results/text_rows.hpp"

namespace text {
namespace {

constexpr int plan_digits = 4;
using PointCells = std::vector<std::string>;

/// The drives at one point of the plan.
struct Point {
  std::vector<std::string> values;
  std::vector<analysis::Statistics> figures;
  std::size_t first = 0, runs = 0, passed = 0;
  analysis::RunEnd end = analysis::RunEnd::whole;  ///< how the first incomplete drive ended
};

std::vector<Point> points_of(const PlanStory& story) {
  std::vector<Point> points;
  const std::size_t drives = std::max<std::size_t>(story.plan.drives, 1);
  story.each([&](const analysis::RunRecord& record) {
    if (points.empty() || record->number / drives != points.back().first / drives)
      points.push_back({record->point, std::vector<analysis::Statistics>(story.columns.figures.size()),
                        record->number, 0, 0});
    Point& at = points.back();
    for (std::size_t n = 0; n < at.figures.size(); ++n) at.figures[n].add(record->figures[n]);
    ++at.runs;
    at.passed += analysis::passed(record);
    if (at.end == analysis::RunEnd::whole) at.end = record->end;
  });
  return points;
}

/// The prefixes of a plan's columns: keys first, then figures.
struct ColumnPrefixes {
  std::vector<SharedPrefix> keys, figures;
};

ColumnPrefixes prefixes_of(const std::vector<Point>& points, const PlanStory& story) {
  ColumnPrefixes out;
  std::vector<double> values;
  for (std::size_t k = 0; k < story.columns.keys.size(); ++k) {
    values.clear();
    for (const Point& point : points)
      if (const std::optional<double> x = number_alone(point.values[k])) values.push_back(*x);
    out.keys.emplace_back(values, story.columns.keys[k].unit);
  }
  for (std::size_t n = 0; n < story.columns.figures.size(); ++n) {
    values.clear();
    for (const Point& point : points)
      if (const std::optional<double> x = point.figures[n].median()) values.push_back(*x);
    out.figures.emplace_back(values, story.columns.figures[n].unit);
  }
  return out;
}

std::string value_text(const std::string& written, const SharedPrefix& prefix) {
  const std::optional<double> x = number_alone(written);
  return x ? prefix.text(*x, plan_digits) : visible(analysis::bare(written));
}

std::string verdict(const Point& point, std::size_t drives, bool asks) {
  // The reason is printed below the table.
  if (point.end != analysis::RunEnd::whole && drives <= 1)
    return point.end == analysis::RunEnd::fault ? "FAULT" : "REFUSED";
  if (!asks) return "";
  if (drives > 1) return fmt::format("{} of {}", point.passed, point.runs);
  return point.passed == 1 ? "ok" : "FAIL";
}

PointCells cells_of(const Point& point, const PlanStory& story, const ColumnPrefixes& prefixes, bool asks) {
  const std::vector<analysis::FigureColumn>& figures = story.columns.figures;
  PointCells cells{fmt::format("{}", point.first)};
  for (std::size_t k = 0; k < point.values.size(); ++k)
    cells.push_back(value_text(point.values[k], prefixes.keys[k]));
  for (std::size_t n = 0; n < figures.size(); ++n) {
    const std::optional<double> x = point.figures[n].median();
    const bool holds = !x || figures[n].holds(*x);
    cells.push_back(x ? prefixes.figures[n].text(*x, plan_digits) + (holds ? "" : " !") : "-");
  }
  cells.push_back(verdict(point, story.plan.drives, asks));
  return cells;
}

std::string legend(const PlanStory& story) {
  std::string text;
  for (std::size_t n = 0; n < story.columns.figures.size(); ++n) {
    const analysis::FigureColumn& f = story.columns.figures[n];
    std::string line = fmt::format("  [{}] {}", n + 1, visible(f.name));
    if (f.min) line += fmt::format(", at least {}", quantity_text(*f.min, f.unit));
    if (f.max) line += fmt::format(", at most {}", quantity_text(*f.max, f.unit));
    text += line + "\n";
  }
  return text;
}

std::string point_table(const PlanStory& story) {
  const bool asks = std::any_of(story.columns.figures.begin(), story.columns.figures.end(),
                                [](const auto& f) { return f.required; });
  PointCells head{"run"};
  for (const analysis::InputColumn& c : story.columns.keys) head.push_back(visible(c.key));
  for (std::size_t n = 0; n < story.columns.figures.size(); ++n) head.push_back(fmt::format("[{}]", n + 1));
  head.push_back(!asks ? "" : story.plan.drives > 1 ? "holds" : "verdict");
  Rows rows(Rows::Side::right);
  rows.add(std::move(head));
  const std::vector<Point> points = points_of(story);
  const ColumnPrefixes prefixes = prefixes_of(points, story);
  for (const Point& point : points) rows.add(cells_of(point, story, prefixes, asks));
  const std::string of =
      story.plan.drives > 1 ? fmt::format(", medians of {} drives", story.plan.drives) : "";
  return fmt::format("{}{}\n", visible(story.name), of) + rows.text() + legend(story) +
         casualties_text(story.series, story.plan) + remarks_text(story.series, story.plan) +
         series_sum(story.series, story.plan);
}

std::string part(const analysis::Estimated& e) {
  return fmt::format("{:.3f} ({:.3f} .. {:.3f})", e.value, e.low, e.high);
}

std::string index_table(const PlanStory& story) {
  std::string text;
  for (std::size_t f = 0; f < story.columns.figures.size(); ++f) {
    const auto found = indices_of(story, f);
    text += fmt::format("  {}: {}\n", visible(story.columns.figures[f].name),
                        found ? "Sobol indices, first order and total, each with its 95 % confidence interval"
                              : "the figure does not vary, or too few runs have a value");
    if (!found) continue;
    Rows rows(Rows::Side::right);
    for (std::size_t k = 0; k < found->size(); ++k)
      rows.add({visible(story.columns.keys[k].key), part((*found)[k].first), part((*found)[k].total)});
    text += rows.text();
    if (analysis::too_few_rows(*found)) text += fmt::format("    {}\n", too_few_points);
  }
  return text;
}

}  // namespace

std::optional<std::vector<analysis::SensitivityIndex>> indices_of(const PlanStory& story,
                                                                  std::size_t figure) {
  std::vector<double> values(analysis::runs_of(story.plan), std::numeric_limits<double>::quiet_NaN());
  story.each([&](const analysis::RunRecord& record) { values[record->number] = record->figures[figure]; });
  return analysis::sensitivity(values, story.plan.axes.size(), story.plan.seed);
}

std::string drawn_text(const std::vector<DriveSpread>& spread, const std::string& not_drawn) {
  std::string text;
  for (const DriveSpread& one : spread)
    text += fmt::format("{}{} {}", text.empty() ? "each drive: " : ", ", visible(one.key), one.width);
  if (!text.empty() && !not_drawn.empty()) text += "\nnot drawn: " + not_drawn;
  return text.empty() ? "" : text + "\n";
}

std::vector<DriveSpread> drive_spreads(const study::Scenario& scenario,
                                       const analysis::PlanColumns& columns) {
  std::vector<DriveSpread> all;
  for (std::size_t n = 0; n < std::min(scenario.spread.size(), columns.strayed.size()); ++n) {
    const study::Spread& spread = scenario.spread[n];
    const bool normal = spread.distribution == study::Distribution::normal;
    const std::string width = spread.relative
                                  ? base::six_digits(100.0 * *spread.relative) + " %"
                                  : quantity_text(spread.absolute.value_or(0.0), columns.strayed[n].unit);
    all.push_back({columns.strayed[n].key, (normal ? "normal, std. dev. " : "+-") + width});
  }
  return all;
}

std::string plan_table(const PlanStory& story) {
  if (story.series.runs > 0 && !story.plan.axes.empty() &&
      analysis::points_of(story.plan) <= most_points_shown)
    return drawn_text(story.spread, story.not_drawn) + point_table(story);
  const std::string indices =
      story.series.runs > 0 && story.plan.sampling == analysis::Sampling::saltelli ? index_table(story) : "";
  return drawn_text(story.spread, story.not_drawn) + indices +
         series_table(story.name, story.series, story.plan);
}

}  // namespace text

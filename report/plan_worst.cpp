// SPDX-License-Identifier: Apache-2.0
#include "report/plan_worst.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "report/figures.hpp"
#include "report/html.hpp"
#include "text/escape/escape.hpp"

namespace report {
namespace {

namespace analysis = sixstep::analysis;
constexpr double infinite = std::numeric_limits<double>::infinity();

void keep(std::vector<NearRun>& worst, const NearRun& run, std::size_t most) {
  const auto behind = std::upper_bound(worst.begin(), worst.end(), run,
                                       [](const NearRun& a, const NearRun& b) { return a.room < b.room; });
  if (behind == worst.end() && worst.size() >= most) return;
  worst.insert(behind, run);
  if (worst.size() > most) worst.pop_back();
}

std::string run_text(const PagePlan& plan, std::size_t number) {
  const auto report = plan.reports.find(number);
  const std::string name = fmt::format("{}\u00a0{}", plan.story.plan.axes.empty() ? "drive" : "run", number);
  return report == plan.reports.end()
             ? name
             : fmt::format("<a href=\"{}\">{}</a>", escaped(text::url_of_name(report->second)), name);
}

std::string command_cell(const PagePlan& plan, std::size_t number) {
  return fmt::format(
      "<td><details><summary>its report</summary><pre class=\"text\">{} {} --html run-{}.html</pre></details></td>",
      escaped(plan.repeats), number, number);
}

std::string room_text(const analysis::FigureColumn& f, const NearRun& run) {
  if (run.room == -infinite) return std::isnan(run.value) ? "has no value" : "never";
  return computed(run.room, f.unit);
}

std::string figure_table(const PagePlan& plan, const analysis::FigureColumn& f,
                         const std::vector<NearRun>& worst) {
  std::string rows;
  for (const NearRun& run : worst) {
    const Judged told = judged(run.value, f.min, f.max, f.unit);
    rows += fmt::format("<tr class=\"{}\"><th scope=\"row\">{}</th>{}{}<td>{}</td>{}</tr>\n",
                        f.holds(run.value) ? "ok" : "bad", run_text(plan, run.number),
                        number_cell(escaped(told.measured)), number_cell(escaped(told.required)),
                        escaped(room_text(f, run)), command_cell(plan, run.number));
  }
  return fmt::format("<h3>{}</h3>\n<table class=\"worst\">{}<tbody>\n{}</tbody></table>\n", escaped(f.name),
                     table_head({"Run", "#Measured", "#Required", "Margin", ""}), rows);
}

std::string casualty_table(const PagePlan& plan, const std::vector<analysis::Casualty>& all,
                           const char* what) {
  if (all.empty()) return "";
  std::string rows;
  for (std::size_t n = 0; n < std::min(all.size(), most_worst); ++n)
    rows += fmt::format("<tr class=\"bad\"><th scope=\"row\">{}</th><td>{}</td>{}</tr>\n",
                        run_text(plan, all[n].number), escaped(all[n].problem),
                        command_cell(plan, all[n].number));
  const std::string which = all.size() > most_worst ? fmt::format(", the first {} of {}", most_worst,
                                                                  grouped(static_cast<long long>(all.size())))
                                                    : std::string();
  return fmt::format("<h3>{}{}</h3>\n<table class=\"worst\">{}<tbody>\n{}</tbody></table>\n", what, which,
                     table_head({"Run", "Why", ""}), rows);
}

}  // namespace

std::vector<std::vector<NearRun>> worst_of(const text::PlanStory& story, std::size_t most) {
  const std::vector<analysis::FigureColumn>& figures = story.columns.figures;
  std::vector<std::vector<NearRun>> worst(figures.size());
  story.each([&](const analysis::RunRecord& record) {
    if (record->end == analysis::RunEnd::refused) return;
    for (std::size_t f = 0; f < figures.size(); ++f)
      if (figures[f].required)
        keep(worst[f], {record->number, record->figures[f], analysis::margin(figures[f], record->figures[f])},
             most);
  });
  return worst;
}

std::vector<std::size_t> worst_runs(const text::PlanStory& story, std::size_t most) {
  const auto worst = worst_of(story, most);
  std::vector<std::size_t> numbers;
  const auto take = [&](std::size_t number) {
    if (numbers.size() < most && std::find(numbers.begin(), numbers.end(), number) == numbers.end())
      numbers.push_back(number);
  };
  for (std::size_t rank = 0; rank < most; ++rank) {
    for (const std::vector<NearRun>& of_figure : worst)
      if (rank < of_figure.size()) take(of_figure[rank].number);
    if (rank < story.series.faults.size()) take(story.series.faults[rank].number);
  }
  return numbers;
}

std::string worst_section(const PagePlan& plan) {
  const text::PlanStory& story = plan.story;
  const auto worst = worst_of(story);
  std::string html;
  for (std::size_t f = 0; f < worst.size(); ++f)
    if (!worst[f].empty()) html += figure_table(plan, story.columns.figures[f], worst[f]);
  html += casualty_table(plan, story.series.faults, "Stopped by a fault");
  html += casualty_table(plan, story.series.refused, "Could not run");
  return html.empty() ? "<p class=\"quiet\">The scenario has no requirements, and no run was stopped.</p>\n"
                      : html;
}

}  // namespace report

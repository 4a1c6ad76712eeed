// SPDX-License-Identifier: Apache-2.0
#include "report/plan_page.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <report_assets.hpp>

#include "report/figures.hpp"
#include "report/html.hpp"
#include "report/plan_json.hpp"
#include "report/plan_pictures.hpp"
#include "report/plan_rows.hpp"
#include "report/plan_worst.hpp"
#include "report/shell.hpp"
#include "sixstep/analysis/plan/plan_description.hpp"
#include "sixstep/base/written.hpp"
#include "text/keys/decimal_number.hpp"

namespace report {
namespace {

namespace analysis = sixstep::analysis;
namespace base = sixstep::base;

constexpr std::string_view plan_colours[most_plans_on_a_page] = {"a", "c"};

std::string count(std::size_t n) { return grouped(static_cast<long long>(n)); }

bool asks(const PagePlan& plan) {
  return std::any_of(plan.story.columns.figures.begin(), plan.story.columns.figures.end(),
                     [](const analysis::FigureColumn& f) { return f.required; });
}

/// The plan's name in the plan's colour, if there are two plans; else empty.
std::string tag(const PlanPageInput& in, std::size_t p) {
  if (in.plans.size() < 2) return "";
  return fmt::format("<span class=\"run\" style=\"border-color: var(--{})\">{}</span> ", plan_colours[p],
                     escaped(in.plans[p].story.name));
}

/// The name of plan `p` on a separate line, above this plan's part of the page.
std::string whose(const PlanPageInput& in, std::size_t p) {
  return in.plans.size() < 2 ? "" : "<p class=\"whose\">" + tag(in, p) + "</p>\n";
}

std::string casualties(const analysis::Series& series) {
  std::string text;
  if (!series.faults.empty()) text += fmt::format(", {} stopped by a fault", count(series.faults.size()));
  if (!series.refused.empty()) text += fmt::format(", {} could not run", count(series.refused.size()));
  return text;
}

std::string verdict(const PlanPageInput& in, std::size_t p) {
  const PagePlan& plan = in.plans[p];
  const analysis::Series& s = plan.story.series;
  const std::size_t wanted = analysis::runs_of(plan.story.plan);
  const bool judges = asks(plan) || s.passed < s.runs;
  const char* css = s.passed < s.runs ? "fail" : judges && s.runs == wanted ? "pass" : "none";
  const std::string line = (judges ? fmt::format("of {} runs hold every requirement", count(s.runs))
                                   : std::string("runs, nothing required")) +
                           casualties(s);
  const std::string alert =
      s.runs == wanted ? ""
                       : fmt::format("<p class=\"alert\">Interrupted: this page has {} of {} runs.</p>\n",
                                     count(s.runs), count(wanted));
  return fmt::format(
      "<section class=\"verdict {}\" aria-label=\"Verdict\">{}<p class=\"word\">{}</p><p class=\"line\">{}</p></section>\n{}",
      css, tag(in, p), count(judges ? s.passed : s.runs), line, alert);
}

std::string plan_fact(std::string_view name, const std::string& html) {
  return fmt::format("<div><dt>{}</dt><dd>{}</dd></div>\n", name, html);
}

/// The values of an axis: numbers with prefix and unit, as on the terminal; words unchanged.
std::string words_of(const analysis::Axis& axis, const std::string& unit) {
  std::string words;
  for (const std::string& value : axis.values) {
    const std::optional<double> number = text::number_alone(value);
    words +=
        (words.empty() ? "" : ", ") + (number ? given(*number, unit) : std::string(analysis::bare(value)));
  }
  return words;
}

std::string range_text(const PagePlan& plan, std::size_t k) {
  const analysis::Axis& axis = plan.story.plan.axes[k];
  const std::string& unit = plan.story.columns.keys[k].unit;
  std::string text =
      axis.values.empty() ? given(axis.from, unit) + " … " + given(axis.to, unit) : words_of(axis, unit);
  if (axis.values.empty() && plan.story.plan.sampling == analysis::Sampling::grid)
    text += fmt::format(", {} values", axis.points);
  if (axis.values.empty() && axis.spacing == analysis::Spacing::logarithmic) text += ", equal factors";
  if (axis.strays) text += "; the controller keeps the nominal value";
  return text;
}

std::string layout_text(const analysis::Plan& plan) {
  if (plan.axes.empty()) return fmt::format("{} drives of a series", count(plan.drives));
  std::string text = fmt::format("{}, {} points", base::word(analysis::sampling_choices, plan.sampling),
                                 count(analysis::points_of(plan)));
  if (plan.drives > 0) text += fmt::format(" of {} drives each", count(plan.drives));
  return text;
}

std::string facts(const PlanPageInput& in, std::size_t p) {
  const PagePlan& plan = in.plans[p];
  std::string html =
      whose(in, p) + "<dl class=\"setup facts\">\n" + plan_fact("Sampling", layout_text(plan.story.plan));
  if (plan.story.plan.drives > 0 || plan.story.plan.sampling != analysis::Sampling::grid)
    html += plan_fact("Seed", std::to_string(plan.story.plan.seed));
  for (std::size_t k = 0; k < plan.story.plan.axes.size(); ++k)
    html += plan_fact(escaped(plan.story.columns.keys[k].key), escaped(range_text(plan, k)));
  if (!plan.story.spread.empty()) {
    std::string names;
    for (const text::DriveSpread& one : plan.story.spread)
      names += (names.empty() ? "" : ", ") +
               escaped(one.key + " " + (one.width.starts_with("+-") ? "±" + one.width.substr(2) : one.width));
    html += plan_fact("Varies from drive to drive", names);
    if (!plan.story.not_drawn.empty()) html += plan_fact("Not drawn", escaped(plan.story.not_drawn));
  }
  return html + plan_fact("Digest of all runs", base::written_hex(plan.story.series.digest)) + "</dl>\n";
}

std::string notes(const PagePlan& plan) {
  return plan.notes.empty() ? "" : fmt::format("<p class=\"notes\">{}</p>\n", escaped(plan.notes));
}

std::string statistics_row(const std::string& tag, const analysis::SpreadFigure& f, std::size_t runs) {
  const analysis::Statistics& s = f.statistics;
  const std::string& unit = f.column.unit;
  const std::string required =
      f.column.required ? judged(0.0, f.column.min, f.column.max, unit).required : "";
  std::string row = fmt::format(
      "<tr{}><th scope=\"row\">{}{}</th>{}{}", f.column.required && f.holds < runs ? " class=\"bad\"" : "",
      tag, escaped(f.column.name), number_cell(escaped(required)),
      number_cell(f.column.required ? fmt::format("{} of {}", count(f.holds), count(runs)) : ""));
  std::vector<std::string> texts =
      computed_alike({s.min(), s.quantile(0.05), s.median(), s.quantile(0.95), s.max(), s.mean()}, unit);
  const std::optional<double> deviation = s.standard_deviation();
  texts.push_back(deviation ? computed(*deviation, unit) : "");
  for (const std::string& text : texts) row += number_cell(text.empty() ? "–" : escaped(text));
  return row + "</tr>\n";
}

std::string statistics(const PlanPageInput& in) {
  std::string rows;
  for (std::size_t p = 0; p < in.plans.size(); ++p)
    for (const analysis::SpreadFigure& f : in.plans[p].story.series.figures)
      rows += statistics_row(tag(in, p), f, in.plans[p].story.series.runs);
  return "<div class=\"wide\"><table class=\"statistics\">" +
         table_head({"Figure", "#Required", "#Holds", "#Least", "#5\u00a0%", "#Median", "#95\u00a0%",
                     "#Greatest", "#Mean", "#Std. dev."}) +
         "<tbody>\n" + rows + "</tbody></table></div>\n";
}

/// A figure of several plans, drawn into one picture with a common axis.
struct Shared {
  const analysis::FigureColumn* column;
  Span span;
  std::vector<std::pair<std::size_t, std::size_t>> in;  ///< pairs: index of a plan, index of the figure in
                                                        ///< this plan
};

std::vector<Shared> shared_figures(const std::vector<PagePlan>& plans) {
  std::vector<Shared> all;
  for (std::size_t p = 0; p < plans.size(); ++p) {
    const std::vector<Span> spans = figure_spans(plans[p].story);
    for (std::size_t f = 0; f < spans.size(); ++f) {
      const analysis::FigureColumn& column = plans[p].story.columns.figures[f];
      auto at = std::find_if(all.begin(), all.end(), [&](const Shared& s) {
        return s.column->name == column.name && s.column->unit == column.unit && s.in.back().first < p;
      });
      if (at == all.end()) at = all.insert(all.end(), {&column, {}, {}});
      at->span.include(spans[f]);
      at->in.emplace_back(p, f);
    }
  }
  return all;
}

std::string distributions(const std::vector<PagePlan>& plans) {
  const std::vector<Shared> all = shared_figures(plans);
  std::vector<std::vector<Histogram>> of_plans;
  for (std::size_t p = 0; p < plans.size(); ++p) {
    std::vector<Span> spans(plans[p].story.columns.figures.size());
    for (const Shared& s : all)
      for (const auto& [plan, figure] : s.in)
        if (plan == p) spans[figure] = s.span;
    of_plans.push_back(histograms(plans[p].story, spans));
  }
  std::string html;
  for (const Shared& s : all) {
    std::vector<DrawnHistogram> drawn;
    for (const auto& [p, f] : s.in) drawn.push_back({plan_colours[p], of_plans[p][f]});
    html += histogram_picture(*s.column, s.span, drawn);
  }
  return html;
}

template <class Section>
std::string for_each_plan(const PlanPageInput& in, Section section, bool tagged = false) {
  std::string html;
  for (std::size_t p = 0; p < in.plans.size(); ++p) {
    const std::string own = section(p);
    html += (tagged && !own.empty() ? whose(in, p) : "") + own;
  }
  return html;
}

/// A note if the drawings show only a part of the runs.
std::string left_out(const PlanPageInput& in) {
  for (const PagePlan& plan : in.plans)
    if (plan.story.series.runs > most_rows_on_a_page / in.plans.size())
      return fmt::format(
          "<p class=\"quiet hint\">The charts show at most {} runs, evenly chosen; the tables include all runs.</p>\n",
          count(most_rows_on_a_page / in.plans.size()));
  return "";
}

}  // namespace

std::string render_plan(const PlanPageInput& in) {
  std::string title = escaped(in.plans.front().title);
  if (in.plans.back().title != in.plans.front().title) title += " and " + escaped(in.plans.back().title);
  std::string motors = in.plans.front().motor;
  if (in.plans.back().motor != motors) motors += " and " + in.plans.back().motor;
  const std::string body =
      filled(assets::plan_html(),
             {{"title", title},
              {"subtitle", escaped(motors)},
              {"verdicts", for_each_plan(in, [&](std::size_t p) { return verdict(in, p); })},
              {"facts", for_each_plan(in, [&](std::size_t p) { return facts(in, p) + notes(in.plans[p]); })},
              {"statistics", statistics(in)},
              {"distributions", distributions(in.plans)},
              {"indices", for_each_plan(
                              in, [&](std::size_t p) { return index_section(in.plans[p]); }, true)},
              {"left_out", left_out(in)},
              {"worst", for_each_plan(
                            in, [&](std::size_t p) { return worst_section(in.plans[p]); }, true)}});
  return in_shell({.title = "Plan · " + title,
                   .body = fmt::format("<style>{}</style>\n", assets::plan_css()) + body,
                   .command = in.command,
                   .version = in.version,
                   .charts = false},
                  plan_data(in.plans),
                  {assets::curves_js(), assets::chart_js(), assets::plan_table_js(), assets::plan_canvas_js(),
                   assets::plan_cloud_js(), assets::plan_heat_js(), assets::plan_parallel_js(),
                   assets::plan_front_js(), assets::plan_js()});
}

}  // namespace report

// SPDX-License-Identifier: Apache-2.0
#include "report/plan_pictures.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "report/figures.hpp"
#include "report/html.hpp"

namespace report {
namespace {

namespace analysis = sixstep::analysis;

constexpr double plot_width = 360, plot_height = 150, plot_left = 12, plot_right = 12, plot_top = 18,
                 plot_bottom = 24;

/// The range of the histogram's axis: the span of the values, and a limit if it is close to the span.
struct Reach {
  double low, high;
  double at(double v) const {
    return plot_left + (v - low) / (high - low) * (plot_width - plot_left - plot_right);
  }
};

std::vector<double> limits_of(const analysis::FigureColumn& f) {
  std::vector<double> limits;
  for (const std::optional<double>& limit : {f.min, f.max})
    if (limit) limits.push_back(*limit);
  return limits;
}

Reach reach_of(const analysis::FigureColumn& f, const Span& span) {
  Reach reach{span.low, span.high};
  const double size = std::max(std::abs(span.low), std::abs(span.high));
  double room = span.high - span.low;
  if (room <= 1e-9 * size) room = size > 0 ? 0.1 * size : 1.0;
  for (const double limit : limits_of(f))
    if (limit > span.low - room && limit < span.high + room) {
      reach.low = std::min(reach.low, limit);
      reach.high = std::max(reach.high, limit);
    }
  const double margin = 0.04 * std::max(room, reach.high - reach.low);
  return {reach.low - margin, reach.high + margin};
}

/// The count as a fraction of all runs of the plan, so that plans of different size can be compared.
double share(const Histogram& h, std::size_t count) {
  const std::size_t all = std::accumulate(h.counts.begin(), h.counts.end(), h.never + h.missing);
  return static_cast<double>(count) / static_cast<double>(std::max<std::size_t>(all, 1));
}

std::string bars(const Reach& reach, const Span& span, const DrawnHistogram& drawn, double most) {
  const double from = reach.at(span.low), to = reach.at(span.high);
  const double each = std::max((to - from) / histogram_bins, to > from ? 0.0 : 6.0);
  std::string path;
  for (std::size_t n = 0; n < histogram_bins; ++n) {
    const std::size_t count = drawn.histogram.counts[n];
    if (count == 0) continue;
    const double tall =
        std::max(1.0, share(drawn.histogram, count) / most * (plot_height - plot_top - plot_bottom));
    const double x = to > from ? from + static_cast<double>(n) * each : from - each / 2;
    path +=
        fmt::format("M{:.1f} {:.1f}v{:.1f}h{:.1f}v{:.1f}z", x, plot_height - plot_bottom, -tall, each, tall);
  }
  return fmt::format("<path d=\"{}\" style=\"fill: var(--{})\"/>", path, drawn.colour);
}

/// About five round numbers below the axis.
std::string ticks(const Reach& reach, const Scale& scale) {
  const double rough = (reach.high - reach.low) * scale.factor / 5,
               power = std::pow(10.0, std::floor(std::log10(rough)));
  double step = power * 10;
  for (const double m : {5.0, 2.0, 1.0})
    if (power * m >= rough) step = power * m;
  std::string svg;
  const auto last = static_cast<long>(std::floor(reach.high * scale.factor / step));
  for (auto n = static_cast<long>(std::ceil(reach.low * scale.factor / step)); n <= last; ++n) {
    const double x = reach.at(static_cast<double>(n) * step / scale.factor);
    const int decimals = std::max(0, -static_cast<int>(std::floor(std::log10(step) + 1e-9)));
    if (x > plot_left + 8 && x < plot_width - plot_right - 8)
      svg += fmt::format("<text x=\"{:.1f}\" y=\"{}\" text-anchor=\"middle\">{:.{}f}</text>", x,
                         plot_height - plot_bottom + 16, static_cast<double>(n) * step, decimals);
  }
  return svg;
}

std::string limit_lines(const analysis::FigureColumn& f, const Reach& reach) {
  std::string svg;
  constexpr double as_wide_as_a_label = 140.0;
  double last = -plot_width;
  int row = 0;
  for (const double limit : limits_of(f)) {
    if (limit < reach.low || limit > reach.high) continue;
    const double x = reach.at(limit);
    const bool flip = x > 0.6 * plot_width;
    row = std::fabs(x - last) < as_wide_as_a_label
              ? row + 1
              : 0;  // a label that would overlap is placed in the next row
    last = x;
    svg += fmt::format(
        "<line class=\"limit\" x1=\"{0:.1f}\" x2=\"{0:.1f}\" y1=\"4\" y2=\"{1}\"/><text x=\"{2:.1f}\" y=\"{5}\" "
        "text-anchor=\"{3}\">{4}</text>",
        x, plot_height - plot_bottom, flip ? x - 4 : x + 4, flip ? "end" : "start",
        escaped(given(limit, f.unit)), 13 + 14 * row);
  }
  return svg;
}

std::string without_value(const std::vector<DrawnHistogram>& drawn) {
  std::size_t never = 0, missing = 0;
  for (const DrawnHistogram& d : drawn) {
    never += d.histogram.never;
    missing += d.histogram.missing;
  }
  std::string text;
  if (never > 0) text += fmt::format("never: {} runs", grouped(static_cast<long long>(never)));
  if (missing > 0)
    text += fmt::format("{}no value: {} runs", text.empty() ? "" : "; ",
                        grouped(static_cast<long long>(missing)));
  return text.empty() ? "" : "<small>" + text + "</small>";
}

std::string index_bar(const analysis::Estimated& e) {
  const auto part = [](double v) { return 100 * std::clamp(v, 0.0, 1.0); };
  return fmt::format(
      "<td class=\"num\">{}</td><td class=\"index\"><span title=\"{} to {}\"><i style=\"width: {:.1f}%\"></i><b style=\"left: "
      "{:.1f}%; width: {:.1f}%\"></b></span></td>",
      plain(e.value, 3), plain(e.low, 3), plain(e.high, 3), part(e.value), part(e.low),
      part(e.high) - part(e.low));
}

std::string index_table(const text::PlanStory& story, std::size_t figure) {
  const auto found = text::indices_of(story, figure);
  const std::string head = fmt::format("<h3>{}</h3>\n", escaped(story.columns.figures[figure].name));
  if (!found) return head + "<p class=\"quiet\">The figure does not vary, or too few runs have it.</p>\n";
  std::string rows;
  for (std::size_t k = 0; k < found->size(); ++k)
    rows += fmt::format("<tr><th scope=\"row\">{}</th>{}{}</tr>\n", escaped(story.columns.keys[k].key),
                        index_bar((*found)[k].first), index_bar((*found)[k].total));
  return head + "<table class=\"indices\">" + table_head({"Key", "#Alone", "", "#In all", ""}) + "<tbody>\n" +
         rows + "</tbody></table>\n" +
         (analysis::too_few_rows(*found) ? fmt::format("<p class=\"quiet\">{}</p>\n", text::too_few_points)
                                         : "");
}

}  // namespace

std::string histogram_picture(const analysis::FigureColumn& f, const Span& span,
                              const std::vector<DrawnHistogram>& drawn) {
  const Scale scale =
      scale_for(span.empty() ? 0.0 : std::max(std::abs(span.low), std::abs(span.high)), f.unit);
  const std::string caption =
      fmt::format("<figcaption><span class=\"name\">{}</span><span class=\"unit\">{}</span>{}</figcaption>",
                  escaped(f.name), escaped(scale.unit), without_value(drawn));
  if (span.empty()) return "<figure class=\"chart drawn histogram\">" + caption + "</figure>\n";
  double most = 0.0;
  for (const DrawnHistogram& d : drawn)
    most = std::max(
        most, share(d.histogram, *std::max_element(d.histogram.counts.begin(), d.histogram.counts.end())));
  const Reach reach = reach_of(f, span);
  std::string svg;
  for (const DrawnHistogram& d : drawn) svg += bars(reach, span, d, most);
  const std::string told = fmt::format("{}: distribution from {} to {}", f.name, computed(span.low, f.unit),
                                       computed(span.high, f.unit));
  return fmt::format(
      "<figure class=\"chart drawn histogram\">{}<svg viewBox=\"0 0 {} {}\" role=\"img\" aria-label=\"{}\">"
      "<line class=\"grid\" x1=\"{}\" x2=\"{}\" y1=\"{}\" y2=\"{}\"/>{}{}{}</svg></figure>\n",
      caption, plot_width, plot_height, escaped(told), plot_left, plot_width - plot_right,
      plot_height - plot_bottom, plot_height - plot_bottom, svg, limit_lines(f, reach), ticks(reach, scale));
}

std::string index_section(const PagePlan& plan) {
  const text::PlanStory& story = plan.story;
  if (story.plan.sampling != analysis::Sampling::saltelli || story.series.runs == 0) return "";
  std::string html =
      "<h2>What each figure depends on</h2>\n<p class=\"quiet\">Sobol indices: the part of a figure’s variance that a key explains alone (first order), and with all interactions (total); the line is the 95\u00a0% confidence interval.</p>\n<div class=\"columns indices-all\">";
  for (std::size_t f = 0; f < story.columns.figures.size(); ++f)
    html += "<div>" + index_table(story, f) + "</div>\n";
  return html + "</div>\n";
}

}  // namespace report

// SPDX-License-Identifier: Apache-2.0
#include "report/contest_page.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <report_assets.hpp>

#include "report/bench_facts.hpp"
#include "report/html.hpp"
#include "report/shell.hpp"
#include "report/svg_chart.hpp"
#include "text/contest/contest_text.hpp"
#include "text/escape/escape.hpp"

namespace report {
namespace {

using namespace sixstep;
using analysis::Contest;
using analysis::contest_figures;
using analysis::ContestRow;
using analysis::ContestTrace;

std::size_t place_of(const Contest& c, const ContestRow& row) {
  return static_cast<std::size_t>(&row - c.rows.data());
}

/// The controller with the least value of a figure, among the controllers that may win; null if none of them
/// has the figure.
const ContestRow* least_of(const Contest& c, std::size_t figure) {
  const ContestRow* least = nullptr;
  for (const ContestRow& row : c.rows)
    if (analysis::may_win(c, place_of(c, row)) && std::isfinite(row.values[figure]) &&
        (least == nullptr || row.values[figure] < least->values[figure]))
      least = &row;
  return least;
}

std::string name_of(const Contest& c, const ContestRow& row) {
  return std::string(c.entries[place_of(c, row)].who->name);
}
/// The controller's number, printed at its point and in front of its name.
std::string number_of(const Contest& c, const ContestRow& row) {
  return fmt::format("{}", place_of(c, row) + 1);
}

std::string facts(const Contest& c) {
  std::string out;
  for (std::size_t f = 0; f < std::size(contest_figures); ++f) {
    const ContestRow* row = least_of(c, f);
    if (row == nullptr) continue;
    out += bench_fact(
        fmt::format("least {}", contest_figures[f].phrase),
        fmt::format("{}: {}", name_of(c, *row), text::contest_value(row->values[f], contest_figures[f])));
  }
  return out;
}

/// Whether the controller is on the Pareto front: no other controller has less ripple at no more losses, or
/// less losses at no more ripple.
bool on_front(const Contest& c, const ContestRow& row) {
  const auto ripple = analysis::ripple_figure, loss = analysis::loss_figure;
  return std::none_of(c.rows.begin(), c.rows.end(), [&](const ContestRow& other) {
    return analysis::may_win(c, place_of(c, other)) && other.values[ripple] <= row.values[ripple] &&
           other.values[loss] <= row.values[loss] &&
           (other.values[ripple] < row.values[ripple] || other.values[loss] < row.values[loss]);
  });
}

SvgChart trade(const Contest& c) {
  SvgChart chart{
      .title = "Torque ripple against losses", .x_label = "rms torque ripple, mN m", .y_label = "W"};
  std::vector<const ContestRow*> front;
  for (const ContestRow& row : c.rows) {
    if (!row.nominal_held) continue;
    const double x = 1e3 * row.values[analysis::ripple_figure], y = row.values[analysis::loss_figure];
    if (!std::isfinite(x) || !std::isfinite(y)) continue;
    const bool best = analysis::may_win(c, place_of(c, row)) && on_front(c, row);
    if (best) front.push_back(&row);
    chart.marks.push_back({x, y, number_of(c, row), best ? "main" : "c"});
  }
  std::sort(front.begin(), front.end(), [](const ContestRow* a, const ContestRow* b) {
    return a->values[analysis::ripple_figure] < b->values[analysis::ripple_figure];
  });
  SvgCurve line{"no other controller has less torque ripple and less loss", "main", {}, {}};
  for (const ContestRow* row : front) {
    line.x.push_back(1e3 * row->values[analysis::ripple_figure]);
    line.y.push_back(row->values[analysis::loss_figure]);
  }
  chart.curves.push_back(std::move(line));
  return chart;
}

/// The speed around the load step: from a tenth of the time until the next part of the course before the
/// step, to half of this time after it.
SvgCurve load_step_of(const Contest& c, const ContestTrace& trace, const char* label, const char* style) {
  const analysis::Course& course = c.bench.course;
  const double before_s = 0.1 * (course.slow_at_s - course.load_at_s), to_s = course.load_at_s + 5 * before_s;
  SvgCurve curve{label, style, {}, {}};
  for (std::size_t n = 0; n < trace.t_s.size(); ++n) {
    if (trace.t_s[n] < course.load_at_s - before_s || trace.t_s[n] > to_s) continue;
    curve.x.push_back(1e3 * (trace.t_s[n] - course.load_at_s));
    curve.y.push_back(trace.speed_rad_s[n]);
  }
  return curve;
}

/// Each controller's response to the load step, drawn over the response of the six-step controller.
std::string load_steps(const Contest& c) {
  const ContestTrace* usual = nullptr;
  for (const ContestRow& row : c.rows)
    if (name_of(c, row) == analysis::six_step_name && !row.trace.t_s.empty()) usual = &row.trace;
  std::string out;
  for (const ContestRow& row : c.rows) {
    if (row.trace.t_s.empty()) continue;
    SvgChart chart{.title = number_of(c, row) + " " + name_of(c, row),
                   .x_label = "ms after the load step",
                   .y_label = "rad/s",
                   .compact = true};
    if (usual != nullptr && usual != &row.trace)
      chart.curves.push_back(load_step_of(c, *usual, analysis::six_step_name.data(), "reference"));
    chart.curves.push_back(load_step_of(c, row.trace, "speed", "a"));
    out += svg_chart(chart);
  }
  return out;
}

std::string html_list(const std::vector<std::string>& lines, std::string_view classes) {
  std::string out = fmt::format("<ul class=\"{}\">\n", classes);
  for (const std::string& line : lines) out += "<li>" + escaped(line) + "</li>\n";
  return lines.empty() ? std::string() : out + "</ul>\n";
}

/// The tables with their titles. In each column, the least value is bold.
std::string tables(const Contest& c) {
  std::string out;
  for (const text::ContestTable& table : text::contest_tables(c)) {
    if (!table.title.empty()) out += "<h3>" + escaped(table.title) + "</h3>\n";
    out += "<div class=\"scroll\" tabindex=\"0\"><table>";
    for (std::size_t r = 0; r < table.rows.size(); ++r) {
      out += r == 0 ? "<thead><tr>" : "<tr>";
      for (std::size_t n = 0; n < table.rows[r].size(); ++n) {
        const std::string cell = escaped(table.rows[r][n]);
        const bool least = r > 0 && cell.ends_with(" *");
        const std::string_view side = n > 0 ? " class=\"num\"" : "";
        out += r == 0 ? fmt::format("<th{}>{}</th>", side, cell)
                      : fmt::format("<td{}>{}{}{}</td>", side, least ? "<b>" : "", cell, least ? "</b>" : "");
      }
      out += r == 0 ? "</tr></thead><tbody>\n" : "</tr>\n";
    }
    out += "</tbody></table></div>\n";
  }
  return out;
}

}  // namespace

std::string render_contest(const ContestPage& page) {
  const Contest& c = page.contest;
  const std::string title =
      escaped(text::visible(fmt::format("Controllers of the {}", c.bench.scenario.motor)));
  const std::string subtitle = fmt::format(
      "{}, each designed by its rule, on one course: start against half of the full load, load step, deceleration to the lowest speed",
      text::compared_controllers(c));
  const std::string body =
      filled(assets::contest_html(), {{"title", title},
                                      {"subtitle", escaped(subtitle)},
                                      {"notes", html_list(text::contest_notes(c), "alert")},
                                      {"facts", facts(c)},
                                      {"words", html_list(text::contest_words(c), "")},
                                      {"tables", tables(c)},
                                      {"legend", html_list(text::contest_legend(c), "legend")},
                                      {"trade", svg_chart(trade(c))},
                                      {"steps", load_steps(c)},
                                      {"rules", html_list(c.bench.rules, "")}});
  return in_shell({.title = title, .body = body, .command = page.command, .version = page.version});
}

}  // namespace report

// SPDX-License-Identifier: Apache-2.0
#include "report/comparison.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <report_assets.hpp>

#include "report/chip_section.hpp"
#include "report/comparison_data.hpp"
#include "report/cost_card.hpp"
#include "report/figures.hpp"
#include "report/highlights.hpp"
#include "report/html.hpp"
#include "report/scenario_differences.hpp"
#include "report/scripts.hpp"
#include "report/shell.hpp"
#include "report/verdicts.hpp"
#include "sixstep/study/scenario/own_numbers.hpp"

namespace report {
namespace {

std::string number(std::size_t place) {
  return fmt::format("<span class=\"run\" style=\"border-color:var(--{})\">{}</span>", run_style(place),
                     place + 1);
}

/// A table whose first column is followed by one column per run.
std::string table(const char* first, std::size_t runs, const std::string& rows) {
  std::string head = fmt::format("<th scope=\"col\">{}</th>", first);
  for (std::size_t k = 0; k < runs; ++k)
    head += fmt::format("<th scope=\"col\" class=\"num\">{}</th>", number(k));
  return fmt::format(
      "<table class=\"compared\" style=\"--runs:{}\"><thead><tr>{}</tr></thead><tbody>\n{}</tbody></table>\n",
      runs, head, rows);
}

std::string run_rows(const std::vector<ComparedRun>& runs) {
  std::string html;
  for (std::size_t k = 0; k < runs.size(); ++k) {
    if (runs[k].outcome == nullptr) {
      html += fmt::format(
          "<tr><td>{}</td><th scope=\"row\">{}<small class=\"aside\">recorded on a board</small></th><td></td><td>{} rows</td></tr>\n",
          number(k), escaped(runs[k].name), runs[k].events.values.front().size());
      continue;
    }
    const Standing verdict = standing(*runs[k].outcome);
    html += fmt::format(
        "<tr><td>{}</td><th scope=\"row\">{}<small class=\"aside\">{}</small></th><td><span class=\"chip "
        "{}\">{}</span></td><td>{}</td></tr>\n",
        number(k), escaped(runs[k].name), escaped(runs[k].scenario.title), verdict.css, verdict.word,
        verdict.line);
  }
  return html;
}

std::string difference_table(const std::vector<ComparedRun>& runs) {
  std::vector<const sixstep::study::Scenario*> scenarios;
  scenarios.reserve(runs.size());
  for (const ComparedRun& run : runs) scenarios.push_back(&run.scenario);
  std::string rows;
  for (const KeyDifference& d : differences(scenarios)) {
    rows += fmt::format("<tr><th scope=\"row\"><code>{}</code></th>", escaped(d.key));
    for (const std::string& v : d.values) rows += fmt::format("<td class=\"num\">{}</td>", escaped(v));
    rows += "</tr>\n";
  }
  return rows.empty() ? "<p class=\"quiet\">No difference that changes a run.</p>\n"
                      : table("Key", runs.size(), rows);
}

/// A figure's value in one run.
struct Measured {
  double value = 0.0;
  std::string css;  ///< "ok" or "bad" if a requirement judges it
};
using Ask = std::function<std::optional<Measured>(const ComparedRun&)>;

const char* mark(const std::string& css) {
  if (css == "ok") return " <b>✓</b>";
  return css == "bad" ? " <b>✗ not met</b>" : "";
}

/// A row of the table with a figure's value in each run, and the deviation from the first run's value.
std::string figure_row(const std::string& name, const std::string& unit, const std::vector<ComparedRun>& runs,
                       const Ask& ask) {
  std::vector<std::optional<Measured>> found;
  found.reserve(runs.size());
  for (const ComparedRun& run : runs) found.push_back(run.outcome ? ask(run) : std::nullopt);
  // A figure is left out if no run has a value, or if all values are zero.
  if (std::ranges::all_of(found, [](const auto& m) { return !m || (m->value == 0.0 && m->css.empty()); }))
    return "";
  std::string html = fmt::format("<tr><th scope=\"row\">{}</th>", with_subscripts(name));
  std::vector<std::optional<double>> values;
  values.reserve(found.size());
  for (const std::optional<Measured>& m : found) values.push_back(m ? std::optional(m->value) : std::nullopt);
  const std::vector<std::string> texts = computed_alike(values, unit);
  for (std::size_t k = 0; k < found.size(); ++k) {
    if (!found[k]) {
      html += "<td class=\"num\">–</td>";
      continue;
    }
    const bool against = k > 0 && found[0] && found[k]->value != found[0]->value;
    const std::string aside = against
                                  ? fmt::format("<small class=\"aside\">{}</small>",
                                                escaped(deviation(found[k]->value, found[0]->value, unit)))
                                  : "";
    html += fmt::format("<td class=\"num {}\">{}{}{}</td>", found[k]->css, escaped(texts[k]),
                        mark(found[k]->css), aside);
  }
  return html + "</tr>\n";
}

/// The rows of all requirements and comparisons, by name, in the order of their first occurrence.
std::string named_figures(const std::vector<ComparedRun>& runs) {
  std::vector<std::pair<std::string, std::string>> names;
  const auto meet = [&](const std::string& figure, const std::string& unit) {
    if (std::ranges::find(names, std::pair{figure, unit}) == names.end()) names.emplace_back(figure, unit);
  };
  for (const ComparedRun& run : runs) {
    if (run.outcome == nullptr) continue;
    for (const auto& v : run.outcome->verdicts) meet(v.figure, v.unit);
    for (const auto& c : run.outcome->comparisons) meet(c.figure, c.unit);
  }
  std::string rows;
  for (const auto& [figure, unit] : names)
    rows += figure_row(figure, unit, runs,
                       [&, figure = figure, unit = unit](const ComparedRun& run) -> std::optional<Measured> {
                         for (const auto& v : run.outcome->verdicts)
                           if (v.figure == figure && v.unit == unit)
                             return Measured{v.measured, v.ok ? "ok" : "bad"};
                         for (const auto& c : run.outcome->comparisons)
                           if (c.figure == figure && c.unit == unit) return Measured{c.measured, ""};
                         return std::nullopt;
                       });
  return rows;
}

std::string energy_rows(const std::vector<ComparedRun>& runs) {
  using Book = sixstep::study::EnergyBook;
  static constexpr std::pair<const char*, double Book::*> entries[] = {
      {"energy supplied", &Book::supplied},       {"share of the copper", &Book::copper},
      {"in switches and diodes", &Book::devices}, {"in friction", &Book::friction},
      {"of friction in the iron", &Book::iron},   {"in the load", &Book::load}};
  const bool iron = std::any_of(runs.begin(), runs.end(), [](const ComparedRun& run) {
    return run.outcome && run.outcome->energy && run.outcome->energy->iron != 0.0;
  });
  std::string rows;
  for (const auto& [name, entry] : entries) {
    if (entry == &Book::iron && !iron) continue;
    rows += figure_row(name, "J", runs, [entry = entry](const ComparedRun& run) -> std::optional<Measured> {
      if (!run.outcome->energy) return std::nullopt;
      return Measured{*run.outcome->energy.*entry, ""};
    });
  }
  return rows;
}

/// Rows of figures that are shown for every run, whatever its requirements are.
std::string usual_figures(const std::vector<ComparedRun>& runs) {
  const auto of_step = [](const ComparedRun& run) {
    const auto step = largest_step(run.events, run.scenario);
    return step ? step_current(run.events, *step) : std::nullopt;
  };
  std::string rows =
      figure_row("peak current of the largest step, its size", "A", runs, [&](const ComparedRun& run) {
        const auto current = of_step(run);
        return current ? std::optional(Measured{std::abs(current->peak_A), ""}) : std::nullopt;
      });
  rows += figure_row("time with the full bus voltage", "s", runs, [](const ComparedRun& run) {
    const auto held = held_back(run.events, run.scenario);
    return held && run.events.whole.empty() ? std::optional(Measured{held->bus_s, ""}) : std::nullopt;
  });
  rows += figure_row("switching frequency of the whole run", "Hz", runs,
                     [](const ComparedRun& run) -> std::optional<Measured> {
                       if (!(run.outcome->simulated_s > 0.0)) return std::nullopt;
                       return Measured{switching_frequency_Hz(*run.outcome), ""};
                     });
  return rows + energy_rows(runs);
}

std::string own_rows(const std::vector<ComparedRun>& runs) {
  std::vector<std::pair<std::string, std::string>> names;
  for (const ComparedRun& run : runs)
    for (const auto& number : sixstep::study::used_numbers(run.scenario.control.own))
      if (const std::pair<std::string, std::string> name{number.is->name, number.is->unit};
          std::ranges::find(names, name) == names.end())
        names.push_back(name);
  std::string rows;
  for (const auto& [name, unit] : names)
    rows += figure_row(name, unit, runs,
                       [&, name = name, unit = unit](const ComparedRun& run) -> std::optional<Measured> {
                         for (const auto& number : sixstep::study::used_numbers(run.scenario.control.own))
                           if (number.is->name == name && number.is->unit == unit)
                             return Measured{number.value, ""};
                         return std::nullopt;
                       });
  return rows;
}

std::string gain_table(const std::vector<ComparedRun>& runs) {
  std::string rows;
  for (const char* loop : {"current", "speed", "position"})
    for (const auto& [symbol, gain] :
         {std::pair{"d_1", &sixstep::study::LoopGains::d1}, std::pair{"d_0", &sixstep::study::LoopGains::d0}})
      rows += figure_row(fmt::format("{} loop, {}", loop, symbol), "", runs,
                         [&, gain = gain](const ComparedRun& run) -> std::optional<Measured> {
                           for (const auto& g : run.outcome->gains)
                             if (g.loop == loop) return Measured{g.*gain, ""};
                           return std::nullopt;
                         });
  rows += own_rows(runs);
  return rows.empty() ? "<p class=\"quiet\">No controller in any run.</p>\n"
                      : table("Gain", runs.size(), rows);
}

std::string chips(const std::vector<ComparedRun>& runs) {
  std::string html;
  for (const ComparedRun& run : runs)
    if (run.outcome) html += chip_section(*run.outcome);
  return html;
}

/// The table of differences between a board's log and the simulation. Empty without a log.
std::string trace_comparison_table(const ComparisonInput& in) {
  if (in.laid_over.empty()) return "";
  std::string rows;
  for (const sixstep::analysis::TraceComparison& one : in.laid_over) {
    const std::string unit = one.column.unit == "1" ? "" : one.column.unit;
    if (one.differing) {
      rows += fmt::format(
          "<tr><th scope=\"row\"><code>{}</code></th><td class=\"num\">{}</td><td class=\"num\">{} differ</td><td></td>"
          "<td class=\"num\">{}</td><td></td></tr>\n",
          escaped(one.column.name), one.rows, *one.differing,
          *one.differing > 0 ? escaped(computed(one.at_s, "s")) : "");
      continue;
    }
    rows += fmt::format(
        "<tr><th scope=\"row\"><code>{}</code></th><td class=\"num\">{}</td><td class=\"num\">{}</td><td "
        "class=\"num\">{}</td><td class=\"num\">{}</td><td class=\"num\">{}</td></tr>\n",
        escaped(one.column.name), one.rows, escaped(computed(one.rms, unit)),
        escaped(computed(one.greatest, unit)), escaped(computed(one.at_s, "s")),
        escaped(computed(one.span, unit)));
  }
  return fmt::format(
      "<h2>Log of the board minus the simulation</h2>\n<p class=\"quiet\">At the log's own instants{}.</p>\n<table><thead><tr><th scope=\"col\">Column</th><th scope=\"col\" class=\"num\">Rows</th><th scope=\"col\" class=\"num\">Rms</th><th scope=\"col\" class=\"num\">Greatest</th><th scope=\"col\" class=\"num\">At</th><th scope=\"col\" class=\"num\">Simulated, from lowest to highest</th></tr></thead><tbody>\n{}</tbody></table>\n",
      in.shift_s == 0.0 ? "" : ", moved by " + escaped(computed(in.shift_s, "s")), rows);
}

}  // namespace

std::string render_comparison(const ComparisonInput& in) {
  std::vector<const sixstep::study::Scenario*> scenarios;
  std::string names;
  for (const ComparedRun& run : in.runs) {
    scenarios.push_back(&run.scenario);
    names += (names.empty() ? "" : ", ") + run.name;
  }
  const bool with_log = in.runs.back().outcome == nullptr;
  const std::string title =
      with_log ? "A board's log over its simulation" : fmt::format("{} runs compared", in.runs.size());
  const std::string body =
      filled(assets::comparison_html(),
             {{"title", title},
              {"subtitle", escaped(names) + "; differences are relative to the first run"},
              {"runs", run_rows(in.runs)},
              {"differences",
               with_log ? "<p class=\"quiet\">The log is assumed to be of this scenario's drive.</p>\n"
                        : difference_table(in.runs)},
              {"figures", table("Figure", in.runs.size(), named_figures(in.runs) + usual_figures(in.runs)) +
                              chips(in.runs) + trace_comparison_table(in)},
              {"plots", assets::plots_html()},
              {"grid", escaped(given(common_grid_s(scenarios), "s"))},
              {"between", with_log ? ", with straight lines between the rows of the log" : ""},
              {"gains", gain_table(in.runs)}});
  return in_shell(
      {.title = title + " · " + escaped(names), .body = body, .command = in.command, .version = in.version},
      comparison_data(in.runs), run_scripts());
}

}  // namespace report

// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <report_assets.hpp>

#include "report/figures.hpp"
#include "report/html.hpp"
#include "report/report.hpp"
#include "report/shell.hpp"
#include "report/verdicts.hpp"
#include "text/escape/escape.hpp"

namespace report {
namespace {

std::string table(const char* css, const char* head, const std::string& rows) {
  if (rows.empty()) return "";
  return fmt::format("<table class=\"{}\"><thead><tr>{}</tr></thead><tbody>\n{}</tbody></table>\n", css, head,
                     rows);
}

std::string linked(const IndexEntry& entry) {
  if (entry.file.empty()) return escaped(entry.title);
  return fmt::format("<a href=\"{}\">{}</a>", text::url_of_name(entry.file), escaped(entry.title));
}

std::string anchor(std::size_t place) { return fmt::format("e{}", place + 1); }

/// The requirement that is closest to its limit, with the remaining distance.
std::string closest_cell(const sixstep::study::Outcome& outcome) {
  const sixstep::study::Verdict* tightest = nullptr;
  for (const auto& v : outcome.verdicts)
    if (room(v) && (!tightest || *room(v) < *room(*tightest))) tightest = &v;
  if (!tightest) return "";
  return fmt::format("{}<small class=\"aside\">{}</small>", with_subscripts(tightest->figure),
                     *room(*tightest) < 0.0 ? "not met" : escaped(room_words(*tightest)));
}

/// The comparison with the largest relative deviation.
std::string furthest(const sixstep::study::Outcome& outcome) {
  const sixstep::study::ComparisonResult* worst = nullptr;
  const auto part = [](const auto& c) { return std::abs((c.measured - c.value) / (c.value - c.zero)); };
  for (const auto& c : outcome.comparisons)
    if (std::isfinite(part(c)) && (!worst || part(c) > part(*worst))) worst = &c;
  if (!worst) return "";
  return fmt::format("{}<small class=\"aside\">{}</small>",
                     escaped(deviation(worst->measured, worst->value, worst->unit)),
                     with_subscripts(worst->figure));
}

/// A table with one line per experiment, with the requirement closest to its limit.
std::string overview(const std::vector<IndexEntry>& entries) {
  std::string rows;
  for (std::size_t n = 0; n < entries.size(); ++n) {
    if (!entries[n].finished) continue;
    const auto& outcome = *entries[n].outcome;
    const Standing verdict = standing(outcome);
    const auto held = std::ranges::count_if(outcome.verdicts, [](const auto& v) { return v.ok; });
    rows += fmt::format(
        "<tr><td><span class=\"chip {}\">{}</span></td><th scope=\"row\"><a href=\"#{}\">{}</a></th>"
        "<td class=\"num\">{}</td><td>{}</td><td class=\"num\">{}</td></tr>\n",
        verdict.css, verdict.word, anchor(n), escaped(entries[n].title),
        outcome.verdicts.empty() ? "" : fmt::format("{} of {}", held, outcome.verdicts.size()),
        closest_cell(outcome), furthest(outcome));
  }
  return table("overview",
               "<th></th><th>Experiment</th><th class=\"num\">Requirements</th><th>Closest requirement</th>"
               "<th class=\"num\">Largest deviation from a comparison value (not required)</th>",
               rows);
}

std::string experiment(const IndexEntry& entry, std::size_t place) {
  const Standing verdict = standing(*entry.outcome);
  std::string html = fmt::format(
      "<section class=\"experiment {0}\" id=\"{3}\"><header><h2>{1}</h2><span class=\"chip "
      "{0}\">{2}</span></header>\n",
      verdict.css, linked(entry), verdict.word, anchor(place));
  if (entry.outcome->fault)
    html += fmt::format("<p class=\"alert\"><b>Fault.</b> {}</p>\n",
                        escaped(sixstep::base::to_string(*entry.outcome->fault)));
  html += table("verdicts",
                "<th></th><th>Figure</th><th class=\"num\">Required</th><th class=\"num\">Measured</th>"
                "<th>Within limits</th>",
                requirement_rows(*entry.outcome));
  html += table("comparisons",
                "<th>Compared with</th><th class=\"num\">Expected</th><th class=\"num\">Measured</th>"
                "<th class=\"num\">Deviation</th><th>Source</th>",
                comparison_rows(*entry.outcome));
  return html + "</section>\n";
}

/// Links to the failed experiments, for readers who open the page after a failure.
std::string failed_list(const std::vector<IndexEntry>& entries) {
  std::string items;
  for (const IndexEntry& entry : entries)
    if (entry.finished && !entry.outcome->passed()) items += "<li>" + linked(entry) + "</li>\n";
  return items.empty() ? items : "<ul class=\"failed\">" + items + "</ul>\n";
}

/// Interrupted runs, and runs that were not started.
std::string unfinished_section(const std::vector<IndexEntry>& entries) {
  std::string items;
  for (const IndexEntry& entry : entries)
    if (!entry.finished)
      items += fmt::format("<li>{}: {}</li>\n", linked(entry),
                           entry.outcome ? "cut short at " + escaped(given(entry.outcome->simulated_s, "s"))
                                         : std::string("without a result"));
  return items.empty() ? items : "<h2>Not finished</h2>\n<ul class=\"unfinished\">" + items + "</ul>\n";
}

/// The verdict of all experiments; if some are not finished, the verdict of the finished ones.
Standing standing_of(const std::vector<IndexEntry>& entries) {
  const auto finished = std::ranges::count_if(entries, [](const IndexEntry& e) { return e.finished; });
  const auto passed =
      std::ranges::count_if(entries, [](const IndexEntry& e) { return e.finished && e.outcome->passed(); });
  const char* css = passed < finished ? "fail" : "pass";
  if (finished == std::ssize(entries))
    return {css, passed == finished ? "PASS" : "FAIL",
            fmt::format("{} of {} experiments pass", passed, entries.size())};
  return {
      passed < finished ? "fail" : "none", "INCOMPLETE",
      fmt::format("{} of {} experiments are finished, {} of these pass", finished, entries.size(), passed)};
}

}  // namespace

std::string render_index(const std::vector<IndexEntry>& entries, std::string_view command,
                         std::string_view version) {
  std::string sections;
  for (std::size_t n = 0; n < entries.size(); ++n)
    if (entries[n].finished) sections += experiment(entries[n], n);
  const Standing verdict = standing_of(entries);
  const std::string body =
      filled(assets::index_html(), {{"standing_class", verdict.css},
                                    {"standing", verdict.word},
                                    {"standing_line", verdict.line},
                                    {"failed", failed_list(entries)},
                                    {"overview", overview(entries)},
                                    {"sections", sections + unfinished_section(entries)}});
  return in_shell({.title = fmt::format("{} · {}", verdict.word, verdict.line),
                   .body = body,
                   .command = command,
                   .version = version,
                   .main_class = "index"});
}

}  // namespace report

// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <report_assets.hpp>

#include "io/report/html.hpp"
#include "io/report/report.hpp"
#include "io/report/shell.hpp"
#include "io/report/verdicts.hpp"

namespace io::report {
namespace {

std::string table(const char* css, const char* head, const std::string& rows) {
  if (rows.empty()) return "";
  return fmt::format("<table class=\"{}\"><thead><tr>{}</tr></thead><tbody>\n{}</tbody></table>\n", css, head,
                     rows);
}

std::string experiment(const IndexEntry& entry) {
  const Standing verdict = standing(*entry.outcome);
  std::string html = fmt::format(
      "<section class=\"experiment {0}\"><header><h2><a href=\"{1}\">{2}</a></h2><span class=\"chip "
      "{0}\">{3}</span>"
      "</header>\n",
      verdict.css, escaped(entry.file), escaped(entry.title), verdict.word);
  if (entry.outcome->fault)
    html += fmt::format("<p class=\"alert\"><b>Fault.</b> {}</p>\n",
                        escaped(sixstep::base::to_string(*entry.outcome->fault)));
  html += table("verdicts",
                "<th></th><th>Figure</th><th class=\"num\">Required</th><th class=\"num\">Measured</th>"
                "<th>Within limits</th>",
                requirement_rows(*entry.outcome));
  html += table("comparisons",
                "<th>Compared with</th><th class=\"num\">There</th><th class=\"num\">Here</th>"
                "<th class=\"num\">Deviation</th><th>Source</th>",
                comparison_rows(*entry.outcome));
  return html + "</section>\n";
}

/// Whoever opens the page after a failure wants to go there at once.
std::string failed_list(const std::vector<IndexEntry>& entries) {
  std::string items;
  for (const IndexEntry& entry : entries)
    if (!entry.outcome->passed())
      items += fmt::format("<li><a href=\"{}\">{}</a></li>\n", escaped(entry.file), escaped(entry.title));
  return items.empty() ? items : "<ul class=\"failed\">" + items + "</ul>\n";
}

}  // namespace

std::string render_index(const std::vector<IndexEntry>& entries, std::string_view command,
                         std::string_view version) {
  std::string sections;
  for (const IndexEntry& entry : entries) sections += experiment(entry);
  const auto passed = std::ranges::count_if(entries, [](const IndexEntry& e) { return e.outcome->passed(); });
  const bool all = passed == static_cast<std::ptrdiff_t>(entries.size());
  const std::string line = fmt::format("{} of {} experiments pass", passed, entries.size());
  const char* word = all ? "PASS" : "FAIL";
  const std::string body = filled(assets::index_html, {{"standing_class", all ? "pass" : "fail"},
                                                       {"standing", word},
                                                       {"standing_line", line},
                                                       {"failed", failed_list(entries)},
                                                       {"sections", sections}});
  return in_shell({.title = fmt::format("{} · {}", word, line),
                   .body = body,
                   .command = command,
                   .version = version,
                   .main_class = "index"});
}

}  // namespace io::report

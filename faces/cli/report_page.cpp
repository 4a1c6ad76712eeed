// SPDX-License-Identifier: Apache-2.0
#include "faces/cli/report_page.hpp"

#include <utility>

#include "io/text_file.hpp"

// SEAM: until io/report lands, a bare page stands in; then the condition and its other branch go.
#if __has_include("io/report/report.hpp")
#include "io/report/report.hpp"

namespace cli {

std::string report_page(const ReportSource& s) {
  base::Result<std::string> text = io::read_text(s.file);
  return io::report::render({.scenario = s.scenario,
                             .outcome = s.outcome,
                             .trace = s.events,
                             .command = s.command,
                             .version = SIXSTEP_VERSION,
                             .scenario_text = text ? std::move(*text) : std::string()});
}

std::string report_index(const std::vector<ReportLink>& links, const std::string& command) {
  std::vector<io::report::IndexEntry> entries;
  for (const ReportLink& link : links) entries.push_back({link.title, link.file, link.outcome});
  return io::report::render_index(entries, command, SIXSTEP_VERSION);
}

}  // namespace cli
#else
namespace cli {

std::string report_page(const ReportSource& s) {
  return "<!doctype html><meta charset=\"utf-8\"><title>sixstep</title>\n<p>" + s.scenario.title + "</p>\n";
}

std::string report_index(const std::vector<ReportLink>& links, const std::string&) {
  std::string page = "<!doctype html><meta charset=\"utf-8\"><title>sixstep</title>\n";
  for (const ReportLink& link : links)
    page += "<p><a href=\"" + link.file + "\">" + link.title + "</a></p>\n";
  return page;
}

}  // namespace cli
#endif

// SPDX-License-Identifier: Apache-2.0
#include "text/results/junit.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "text/escape/escape.hpp"
#include "text/results/quantity_text.hpp"

namespace text {
namespace {

std::string junit_bounds(const std::optional<double>& min, const std::optional<double>& max,
                         const std::string& unit) {
  std::string text;
  if (min) text += fmt::format(" at least {}", quantity_text(*min, unit));
  if (max) text += fmt::format("{} at most {}", min ? " and" : "", quantity_text(*max, unit));
  return text;
}

JunitCase whole_run(std::string failure) { return {"runs to its end", std::move(failure), true}; }

std::string case_xml(const std::string& suite, const JunitCase& c) {
  std::string text =
      fmt::format("    <testcase classname=\"{}\" name=\"{}\"", markup_text(suite), markup_text(c.name));
  if (c.failure.empty()) return text + "/>\n";
  return text + fmt::format(">\n      <{} message=\"{}\"/>\n    </testcase>\n",
                            c.broken ? "error" : "failure", markup_text(c.failure));
}

template <class Which>
std::size_t count(const JunitSuite& suite, const Which& which) {
  return static_cast<std::size_t>(std::count_if(suite.cases.begin(), suite.cases.end(), which));
}

bool fails(const JunitCase& c) { return !c.failure.empty() && !c.broken; }
bool is_error(const JunitCase& c) { return !c.failure.empty() && c.broken; }

}  // namespace

JunitSuite junit_suite(const std::string& name, const study::Outcome& outcome) {
  JunitSuite suite{name, {whole_run(outcome.fault ? base::to_string(*outcome.fault) : std::string())}};
  for (const study::Verdict& v : outcome.verdicts)
    suite.cases.push_back(
        {v.figure,
         v.ok ? std::string()
              : quantity_text(v.measured, v.unit) + ", required" + junit_bounds(v.min, v.max, v.unit),
         false});
  return suite;
}

JunitSuite junit_suite(const std::string& name, const analysis::Series& series) {
  std::string broken;
  if (!series.faults.empty())
    broken += fmt::format("{} stopped by a fault, first run {}: {}", series.faults.size(),
                          series.faults.front().number, series.faults.front().problem);
  if (!series.refused.empty())
    broken +=
        fmt::format("{}{} could not run, first run {}: {}", broken.empty() ? "" : "; ", series.refused.size(),
                    series.refused.front().number, series.refused.front().problem);
  JunitSuite suite{name, {whole_run(broken)}};
  for (const analysis::SpreadFigure& f : series.figures) {
    if (!f.column.required) continue;
    suite.cases.push_back({f.column.name,
                           f.holds == series.runs
                               ? std::string()
                               : fmt::format("holds in {} of {}, required{}", f.holds, series.runs,
                                             junit_bounds(f.column.min, f.column.max, f.column.unit)),
                           false});
  }
  return suite;
}

JunitSuite junit_suite(const std::string& name, const base::Problems& problems) {
  std::string told;
  for (const base::Problem& problem : problems) told += (told.empty() ? "" : "; ") + base::to_string(problem);
  return {name, {whole_run(told)}};
}

std::string junit_xml(std::span<const JunitSuite> suites) {
  std::size_t tests = 0, failures = 0, errors = 0;
  std::string inner;
  for (const JunitSuite& suite : suites) {
    const std::size_t failed = count(suite, fails), broken = count(suite, is_error);
    inner += fmt::format("  <testsuite name=\"{}\" tests=\"{}\" failures=\"{}\" errors=\"{}\">\n",
                         markup_text(suite.name), suite.cases.size(), failed, broken);
    for (const JunitCase& c : suite.cases) inner += case_xml(suite.name, c);
    inner += "  </testsuite>\n";
    tests += suite.cases.size();
    failures += failed;
    errors += broken;
  }
  return fmt::format(
      "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
      "<testsuites name=\"sixstep {}\" tests=\"{}\" failures=\"{}\" errors=\"{}\">\n{}</testsuites>\n",
      SIXSTEP_VERSION, tests, failures, errors, inner);
}

}  // namespace text

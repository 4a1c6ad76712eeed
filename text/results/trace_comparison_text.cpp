// SPDX-License-Identifier: Apache-2.0
#include "text/results/trace_comparison_text.hpp"

#include <fmt/format.h>

#include "text/escape/escape.hpp"
#include "text/results/quantity_text.hpp"
#include "text/results/text_rows.hpp"

namespace text {

std::string trace_comparison_text(const std::string& name,
                                  const std::vector<analysis::TraceComparison>& columns, double shift_s,
                                  const std::vector<std::string>& notes) {
  Rows rows;
  for (const analysis::TraceComparison& one : columns) {
    if (one.differing) {
      rows.add({one.column.name, fmt::format("{} rows", one.rows), fmt::format("{} differ", *one.differing),
                *one.differing > 0 ? "the first at " + quantity_text(one.at_s, "s", 4) : "", ""});
      continue;
    }
    const std::string unit = one.column.unit == "1" ? "" : one.column.unit;
    const auto said = [&unit](double x) { return quantity_text(x, unit, 3); };
    rows.add({one.column.name, fmt::format("{} rows", one.rows), "rms " + said(one.rms),
              fmt::format("at most {} at {}", said(one.greatest), quantity_text(one.at_s, "s", 4)),
              fmt::format("of a range of {} in the simulation", said(one.span))});
  }
  std::string out =
      fmt::format("{} minus the simulation{}:\n{}", name,
                  shift_s == 0.0 ? "" : ", moved by " + quantity_text(shift_s, "s", 3), rows.text());
  for (const std::string& note : notes) out += fmt::format("  {}\n", visible(note));
  return out;
}

}  // namespace text

// SPDX-License-Identifier: Apache-2.0
// Controllers side by side as tables, as plain words, and for programs.
#pragma once
#include <string>
#include <string_view>
#include <vector>

#include "sixstep/analysis/contest/contest.hpp"
#include "text/rooms.hpp"

namespace text {

/// The core of the table's costs, in float; all cores stand in docs/reference/core-costs.md.
inline constexpr std::string_view contest_core = "Cortex-M4F";

/// "8.22 mN m", "34.6 %"; "never" where it never comes, "-" where there is none.
std::string contest_value(double x, const analysis::ContestFigure& figure);

/// Who wins where, and the answer to "six-step or field-oriented?": sentences made of the numbers by rules. Controllers that do not
/// hold the course are left out.
std::vector<std::string> contest_words(const analysis::Contest& contest);

/// A line per controller that this motor or board does not let be, or that does not hold the course: why.
std::vector<std::string> contest_notes(const analysis::Contest& contest);

/// A table as it is printed: heads first, then a row for each controller that runs. "*" marks the least of a column.
struct ContestTable {
  std::string title;  ///< of the first table of a pair: what drives the figures are of
  std::vector<std::vector<std::string>> rows;
};
/// The figures of the nominal drive, and the worst of the series where one was run; two tables each, while the speed changes and steady.
std::vector<ContestTable> contest_tables(const analysis::Contest& contest);

/// What the marks and heads of the tables mean, a line each.
std::vector<std::string> contest_legend(const analysis::Contest& contest);

/// What is common, the tables, nominal and worst, and the words.
std::string contest_text(const analysis::Contest& contest);

/// A line per controller and drive, "nominal" or "worst".
std::string contest_csv(const analysis::Contest& contest);

/// Everything, with the keys of each.
std::string contest_json(const analysis::Contest& contest);

}  // namespace text

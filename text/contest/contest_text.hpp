// SPDX-License-Identifier: Apache-2.0
// Prints a comparison of controllers as tables, as sentences, as CSV and as JSON.
#pragma once
#include <string>
#include <string_view>
#include <vector>

#include "sixstep/analysis/contest/contest.hpp"
#include "text/rooms.hpp"

namespace text {

/// The core whose costs the table shows, for controllers in float; docs/reference/core-costs.md has all
/// cores.
inline constexpr std::string_view contest_core = "Cortex-M4F";

/// A figure's value for the table, such as "8.22 mN m" or "34.6 %"; "never" if its event does not occur, "-"
/// without a value.
std::string contest_value(double x, const analysis::ContestFigure& figure);

/// A figure's value for the nominal drive as its column of the table shows it, whose values have one prefix.
std::string contest_cell(const analysis::Contest& contest, std::size_t figure, double x);

/// Sentences that fixed rules make from the numbers: which controller wins in which figure, and the answer to
/// "six-step or field-oriented?". Controllers that do not follow the course are omitted.
std::vector<std::string> contest_words(const analysis::Contest& contest);

/// One line with the reason for each controller that is impossible with this motor or board, or that does not
/// follow the course.
std::vector<std::string> contest_notes(const analysis::Contest& contest);

/// A printed table: column heads, then a row for each controller that runs. "*" marks the least value of a
/// column.
struct ContestTable {
  std::string title;  ///< title above the first table of a pair; it names the drives of the pair
  std::vector<std::vector<std::string>> rows;
};
/// Tables of the nominal drive, and of the worst drives if a series was run. Two tables each: during speed
/// changes, and in steady state.
std::vector<ContestTable> contest_tables(const analysis::Contest& contest);

/// Explains the marks and heads of the tables, one line each.
std::vector<std::string> contest_legend(const analysis::Contest& contest);

/// The number of compared controllers: "20 controllers", or "16 of 20 controllers" if some cannot run.
std::string compared_controllers(const analysis::Contest& contest);

/// The whole comparison: common conditions, tables (nominal and worst) and sentences.
std::string contest_text(const analysis::Contest& contest);

/// The comparison as CSV. One line per controller and drive, "nominal" or "worst".
std::string contest_csv(const analysis::Contest& contest);

/// The comparison as JSON: all results, with the keys of each controller.
std::string contest_json(const analysis::Contest& contest);

}  // namespace text

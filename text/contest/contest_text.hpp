// SPDX-License-Identifier: Apache-2.0
// Prints a comparison of controllers as tables, as sentences, as CSV and as JSON.
#pragma once
#include <string>
#include <string_view>
#include <vector>

#include "sixstep/analysis/contest/contest.hpp"
#include "text/rooms.hpp"

namespace text {

/// The core whose costs the table shows, for controllers in float. docs/reference/core-costs.md lists all
/// cores.
inline constexpr std::string_view contest_core = "Cortex-M4F";

/// A figure's value for the table, such as "8.22 mN m" or "34.6 %". It is "never" if the figure's event does
/// not occur, and "-" if the figure has no value.
std::string contest_value(double x, const analysis::ContestFigure& figure);

/// Text of a value in the table of nominal drives. All values of a column have the same SI prefix.
std::string contest_cell(const analysis::Contest& contest, std::size_t figure, double x);

/// Sentences that fixed rules derive from the numbers. They say which controller is best in each figure, and
/// answer "six-step or field-oriented?". Controllers that do not follow the course are omitted.
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
/// The tables of the nominal drive. If a series was run, also the tables of the worst drives. Each of the two
/// pairs has one table for speed changes and one for steady state.
std::vector<ContestTable> contest_tables(const analysis::Contest& contest);

/// Explains the marks and heads of the tables, one line each.
std::vector<std::string> contest_legend(const analysis::Contest& contest);

/// The number of compared controllers: "20 controllers", or "16 of 20 controllers" if some cannot run.
std::string compared_controllers(const analysis::Contest& contest);

/// The whole comparison: common conditions, tables (nominal and worst) and sentences.
std::string contest_text(const analysis::Contest& contest);

/// The comparison as CSV. Each controller has one line for its nominal drive and, with a series, one for its
/// worst.
std::string contest_csv(const analysis::Contest& contest);

/// The comparison as JSON: all results, with the keys of each controller.
std::string contest_json(const analysis::Contest& contest);

}  // namespace text

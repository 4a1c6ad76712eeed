// SPDX-License-Identifier: Apache-2.0
// What was required, what was measured, and how that compares with what others say.
#pragma once
#include <optional>
#include <string>

#include "sixstep/study/measure/outcome.hpp"

namespace report {

/// How a run ended: a run that requires nothing has neither passed nor failed.
struct Standing {
  std::string css;   ///< "pass", "fail", "none"
  std::string word;  ///< "PASS", "FAIL", "NO REQUIREMENT"
  std::string line;  ///< "3 of 3 requirements hold"
};
Standing standing(const sixstep::study::Outcome& outcome);

/// How much of the way from the middle of the limits to the nearer one is left, or from nothing to a single
/// limit; below zero where it is not met. Empty where that says nothing.
std::optional<double> room(const sixstep::study::Verdict& verdict);
/// "1.5 % below its limit", "0.2 A from the nearer of its limits"; of a verdict that has room, met.
std::string room_words(const sixstep::study::Verdict& verdict);

/// Rows of the requirement table: mark, figure, required, measured, place within the limits.
std::string requirement_rows(const sixstep::study::Outcome& outcome);

/// Rows of the comparison table: figure, source's value, measured, deviation, source.
std::string comparison_rows(const sixstep::study::Outcome& outcome);

}  // namespace report

// SPDX-License-Identifier: Apache-2.0
// Writes the requirements with their measured values, and the comparison with values from other sources.
#pragma once
#include <optional>
#include <string>

#include "sixstep/study/measure/outcome.hpp"

namespace report {

/// The verdict of a run. A run without requirements has neither passed nor failed.
struct Standing {
  std::string css;   ///< "pass", "fail", "none"
  std::string word;  ///< "PASS", "FAIL", "NO REQUIREMENT"
  std::string line;  ///< "3 of 3 requirements hold"
};
Standing standing(const sixstep::study::Outcome& outcome);

/// The distance to the closer limit, relative to half the distance between the two limits, or to the only
/// limit. Negative if the requirement is missed. Empty if the distance is not defined.
std::optional<double> room(const sixstep::study::Verdict& verdict);
/// The distance in words: "1.5 % below its limit", "0.2 A from the nearer of its limits". Only for a
/// requirement that holds and has a room().
std::string room_words(const sixstep::study::Verdict& verdict);

/// Rows of the requirement table: mark, figure, required value, measured value, and position within the
/// limits.
std::string requirement_rows(const sixstep::study::Outcome& outcome);

/// Rows of the comparison table: figure, source's value, measured, deviation, source.
std::string comparison_rows(const sixstep::study::Outcome& outcome);

}  // namespace report

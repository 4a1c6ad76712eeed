// SPDX-License-Identifier: Apache-2.0
// Prints a design for the terminal: the verdict first, then every step in numbers.
#pragma once
#include <string>

#include "sixstep/analysis/verify/design_study.hpp"
#include "text/rooms.hpp"

namespace text {

std::string design_text(const analysis::DesignStudy& study, bool colour);

/// The verdict: "usable, 2 warnings: the current loop settles within 2 % in 990 us (designed: 1 ms),
/// overshoot 0.2 A".
std::string design_verdict(const analysis::DesignStudy& study);

/// The figure for display: an expected value that is only rounding, compared with the reference, becomes 0.
study::ComparisonResult as_shown(study::ComparisonResult figure, const study::Scenario& scenario);

/// Lines for the head of a scenario file: the source of the gains, and one line per loop.
std::vector<std::string> design_lines(const analysis::DesignStudy& study, bool of_a_board = false);

}  // namespace text

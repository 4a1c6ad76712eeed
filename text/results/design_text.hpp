// SPDX-License-Identifier: Apache-2.0
// A design for the terminal: the verdict first, then every step in numbers.
#pragma once
#include <string>

#include "sixstep/analysis/verify/design_study.hpp"
#include "text/rooms.hpp"

namespace text {

std::string design_text(const analysis::DesignStudy& study, bool colour);

/// "usable, 2 warnings: the current loop settles to 2 % in 990 us (1 ms to 1 % asked for), overshoot 0.2 A"
std::string design_verdict(const analysis::DesignStudy& study);

/// A figure as a reader is shown it: an expected value of rounding's size, beside what the reference asks for, is 0.
study::ComparisonResult as_shown(study::ComparisonResult figure, const study::Scenario& scenario);

/// For the head of a scenario file: where the gains come from, one line per loop.
std::vector<std::string> design_lines(const analysis::DesignStudy& study, bool of_a_board = false);

}  // namespace text

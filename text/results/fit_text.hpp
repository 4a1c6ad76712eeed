// SPDX-License-Identifier: Apache-2.0
// Prints constants that were fitted to recordings: for a terminal, as JSON.
#pragma once
#include <string>

#include "sixstep/analysis/identification/fit/fit_result.hpp"
#include "text/rooms.hpp"

namespace text {

/// Frame of a fitted constant in words ("terminal", "peak of a phase"); empty if the value has none.
std::string fit_frame(const design::Sheet& sheet, const analysis::FittedValue& value);

/// `sheet` is analysis::fitted_sheet().
std::string fit_text(const analysis::Fit& fit, const design::Sheet& sheet);

std::string fit_json(const analysis::Fit& fit, const design::Sheet& sheet);

/// One line for the motor's file for each fitted constant of the motor.
std::string fit_motor_lines(const analysis::Fit& fit, const design::Sheet& sheet);

}  // namespace text

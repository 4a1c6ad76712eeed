// SPDX-License-Identifier: Apache-2.0
// Ranges in words, for messages and help.
#pragma once
#include <string>

#include "sixstep/base/describe.hpp"
#include "sixstep/base/problem.hpp"

namespace sixstep::base {

/// "must be above 0 and at most 1"; "must be a finite number" for a range open on both ends.
std::string limit_of(const Range& range);

/// What the number x of a key breaks: its own range, or what is plausible in its unit.
std::string limit_of(const Range& own, const Range& allowed, double x);

/// The Problem of a number in this unit that is out of its own range or not plausible; empty for one that is.
Problems out_of_range(const char* where, double x, const Range& own, std::string_view unit, const char* cure);

}  // namespace sixstep::base

// SPDX-License-Identifier: Apache-2.0
// Writes ranges as text, for messages and help.
#pragma once
#include <string>

#include "sixstep/base/describe.hpp"
#include "sixstep/base/problem.hpp"

namespace sixstep::base {

/// The range as a clause: "must be above 0 and at most 1"; "must be a finite number" for an unbounded range.
std::string limit_of(const Range& range);

/// The limit that x, the number of a key, violates: the key's own range, or else the plausible range of its
/// unit.
std::string limit_of(const Range& own, const Range& allowed, double x);

/// The Problem of a number that is outside its own range or implausible in its unit; empty if the number is
/// allowed.
Problems out_of_range(const char* where, double x, const Range& own, std::string_view unit, const char* cure);

}  // namespace sixstep::base

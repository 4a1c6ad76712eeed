// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstddef>
#include <string>

#include "sixstep/analysis/statistics/series.hpp"
#include "text/rooms.hpp"

namespace text {

/// Many runs for the terminal: each figure's spread and how many hold each requirement, what went wrong, and how to look at
/// one alone. Of a plan that was interrupted, of how many.
std::string series_table(const std::string& name, const analysis::Series& series, const analysis::Plan& plan);

// Its parts, for who shows the figures otherwise.
/// Who was stopped or refused, and the first that misses each requirement; a line each.
std::string casualties_text(const analysis::Series& series, const analysis::Plan& plan);
/// The first of these alone: how many were stopped or refused, and why the first.
std::string stopped_text(const analysis::Series& series, const analysis::Plan& plan);
/// The last line: "1000 drives, seed 1: all hold every requirement".
std::string series_sum(const analysis::Series& series, const analysis::Plan& plan);
/// The options that run number `number` alone: "--only 12".
std::string repeats_text(const analysis::Plan& plan, std::size_t number);

}  // namespace text

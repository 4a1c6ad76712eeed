// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstdint>
#include <string>

#include "sixstep/analysis/series/series.hpp"
#include "text/rooms.hpp"

namespace text {

/// A series for the terminal: each figure's spread and how many drives hold each requirement, what went
/// wrong, and how to look at one drive alone. Of a series that was interrupted, `wanted` says of how many.
std::string series_table(const std::string& name, const analysis::Series& series, std::uint64_t seed,
                         std::size_t wanted);

}  // namespace text

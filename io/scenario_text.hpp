// SPDX-License-Identifier: Apache-2.0
// A scenario as the file that says it.
#pragma once
#include <string>
#include <vector>

#include "io/rooms.hpp"
#include "sixstep/study/scenario.hpp"

namespace io {

/// TOML that reads back as the same scenario, to the bit: what differs from the defaults, in the order of the
/// descriptions. The motor is named, its sheet is not written: overrides of single values are lost. Each of
/// `comments` becomes a line of its own above it.
std::string scenario_text(const study::Scenario& scenario, const std::vector<std::string>& comments = {});

}  // namespace io

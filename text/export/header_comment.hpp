// SPDX-License-Identifier: Apache-2.0
// The comment that an exported header begins with: motor, gains and where they come from, what the board calls, and what its run showed.
#pragma once
#include <string>

#include "sixstep/study/compile/compile.hpp"
#include "text/export/config_header.hpp"

namespace text {

std::string header_comment(const ConfigHeader& wanted, const study::Compiled& compiled);

/// Whether any of a range is given.
bool states_range(const design::OperatingRange& range);

}  // namespace text

// SPDX-License-Identifier: Apache-2.0
// Writes the comment at the top of an exported header: motor, gains and their sources, the calls that the
// board makes, and the results of the run.
#pragma once
#include <string>

#include "sixstep/study/compile/compile.hpp"
#include "text/export/config_header.hpp"

namespace text {

std::string header_comment(const ConfigHeader& wanted, const study::Compiled& compiled);

/// Whether any member of the range is given.
bool states_range(const design::OperatingRange& range);

}  // namespace text

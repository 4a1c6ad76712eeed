// SPDX-License-Identifier: Apache-2.0
// The 36 ways to plug a motor in, for a terminal.
#pragma once
#include <string>

#include "sixstep/analysis/wiring/wiring_study.hpp"
#include "text/rooms.hpp"

namespace text {

/// The drive's commutation; what each wiring does; what that looks like at the bench; what cures it; where theory and simulation
/// differ, if they do.
std::string wiring_text(const analysis::WiringStudy& study);

}  // namespace text

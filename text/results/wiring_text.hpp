// SPDX-License-Identifier: Apache-2.0
// Prints the 36 ways to connect a motor, for a terminal.
#pragma once
#include <string>

#include "sixstep/analysis/wiring/wiring_study.hpp"
#include "text/rooms.hpp"

namespace text {

/// Prints the drive's commutation; the behaviour of each wiring, its symptom at the bench and its cure; and
/// the differences between theory and simulation, if there are any.
std::string wiring_text(const analysis::WiringStudy& study);

}  // namespace text

// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <string>

#include "sixstep/analysis/wiring/wiring_study.hpp"
#include "text/rooms.hpp"

namespace text {

/// For programs, in full precision: the commutation table, the bench, and of each of the 36 wirings what theory says, what was
/// measured, whether both agree, and the cures. The same study gives the same bytes.
std::string wiring_json(const analysis::WiringStudy& study);

}  // namespace text

// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <string>

#include "sixstep/analysis/wiring/wiring_study.hpp"
#include "text/rooms.hpp"

namespace text {

/// JSON in full precision: the commutation table, the bench, and for each of the 36 wirings the theory, the
/// measurement, whether both agree, and the cures. The same study gives the same bytes.
std::string wiring_json(const analysis::WiringStudy& study);

}  // namespace text

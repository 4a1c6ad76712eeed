// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "report/wiring_drawing.hpp"

namespace report {

/// Draws, over one electrical turn: the Hall lines, the phases' back-EMFs, and the legs that the drive's
/// table sets high, low or off.
Panel commutation_picture(const sixstep::analysis::WiringStudy& study);

}  // namespace report

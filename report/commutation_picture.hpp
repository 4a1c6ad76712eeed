// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "report/wiring_drawing.hpp"

namespace report {

/// Draws over one electrical turn: the Hall lines, the phases' back-EMF, and which legs the drive's table has
/// high, low and floating.
Panel commutation_picture(const sixstep::analysis::WiringStudy& study);

}  // namespace report

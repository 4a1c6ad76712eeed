// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "report/wiring_drawing.hpp"

namespace report {

/// Six by six: of each wiring its torque over an electrical turn, by theory filled and as measured in a line, and below what the
/// rotor does from six starts. Rows are orders of the phases at the legs, columns orders of the probes at the pins.
Panel wiring_grid(const sixstep::analysis::WiringStudy& study);

/// A card for each thing that a wiring does: the current as a bench sees it, in words what else is seen, and the next step.
Panel wiring_cards(const sixstep::analysis::WiringStudy& study, double height);

}  // namespace report

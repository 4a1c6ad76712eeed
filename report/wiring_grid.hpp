// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "report/wiring_drawing.hpp"

namespace report {

/// The 36 wirings as a grid. Rows are orders of the phases at the legs, columns are orders of the probes at
/// the pins. Each cell shows the torque over an electrical turn, theory as an area and measurement as a line.
/// Below the torque, it shows the rotor's motion from six start angles.
Panel wiring_grid(const sixstep::analysis::WiringStudy& study);

/// A card for each behaviour of a wiring: the current at the bench, the other symptoms in words, and the next
/// step.
Panel wiring_cards(const sixstep::analysis::WiringStudy& study, double height);

}  // namespace report

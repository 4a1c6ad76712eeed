// SPDX-License-Identifier: Apache-2.0
// Draws the 36 ways to connect a motor as one picture, in which a user with swapped wires can look up the
// symptom.
#pragma once
#include <string>
#include <string_view>

#include "report/wiring_drawing.hpp"

namespace report {

/// A self-contained SVG file, light or dark like the viewer's setting: all wirings, the symptoms of each
/// behaviour at the bench, the drive's commutation, and the steps to take. The same study gives the same
/// bytes.
std::string wiring_picture(const sixstep::analysis::WiringStudy& study, std::string_view version);

/// A panel as a figure of a page.
std::string in_figure(const Panel& panel, std::string_view label);

}  // namespace report

// SPDX-License-Identifier: Apache-2.0
// The 36 ways to plug a motor in as one picture, in which a person with swapped wires recognises the symptom.
#pragma once
#include <string>
#include <string_view>

#include "report/wiring_drawing.hpp"

namespace report {

/// An SVG file that needs nothing else, light or dark as its reader is: all wirings, what each kind looks like at the bench, the
/// drive's commutation, and what to do. The same study gives the same bytes.
std::string wiring_picture(const sixstep::analysis::WiringStudy& study, std::string_view version);

/// A panel as a figure of a page.
std::string in_figure(const Panel& panel, std::string_view label);

}  // namespace report

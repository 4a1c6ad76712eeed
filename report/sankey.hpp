// SPDX-License-Identifier: Apache-2.0
// Where the energy of a run came from and where it went, as one drawing.
#pragma once
#include <string>

#include "sixstep/study/measure/outcome.hpp"

namespace report {

/// A <figure> with an SVG, from left to right: what gave energy, over the run, on the left, what took it on
/// the right, whichever it was. Empty where nothing flowed, or where the sums do not close to half a pixel:
/// then it would show what is not so.
std::string energy_sankey(const sixstep::study::EnergyBook& book);

}  // namespace report

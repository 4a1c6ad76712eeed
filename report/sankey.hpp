// SPDX-License-Identifier: Apache-2.0
// Draws the energy flow of a run.
#pragma once
#include <string>

#include "sixstep/study/measure/outcome.hpp"

namespace report {

/// A <figure> with an SVG: on the left the sources of energy over the run, on the right the sinks. Empty if
/// no energy flowed, or if the sums differ by more than half a pixel, because the picture would then be
/// wrong.
std::string energy_sankey(const sixstep::study::EnergyBook& book);

}  // namespace report

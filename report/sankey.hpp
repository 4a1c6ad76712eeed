// SPDX-License-Identifier: Apache-2.0
// Draws the energy flow of a run.
#pragma once
#include <string>

#include "sixstep/study/measure/outcome.hpp"

namespace report {

/// A <figure> with an SVG: the sources of the run's energy on the left, the sinks on the right. Empty if no
/// energy flowed. Also empty if the sums of sources and sinks differ by more than half a pixel, because the
/// picture would then be wrong.
std::string energy_sankey(const sixstep::study::EnergyBook& book);

}  // namespace report

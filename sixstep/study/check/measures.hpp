// SPDX-License-Identifier: Apache-2.0
// Checks which figure can be measured of which signal, in which mode and over which window.
#pragma once
#include "sixstep/base/problem.hpp"
#include "sixstep/study/scenario/scenario.hpp"

namespace sixstep::study {

/// Finds all contradictions in [[require]] and [[compare]]. Figures that depend on the reference are judged
/// only if the references themselves are sound.
void check_measures(const Scenario& scenario, bool sound_references, base::Problems& out);

}  // namespace sixstep::study

// SPDX-License-Identifier: Apache-2.0
// Which figure can be taken of which signal, in which mode and over which window.
#pragma once
#include "sixstep/base/problem.hpp"
#include "sixstep/study/scenario/scenario.hpp"

namespace sixstep::study {

/// All contradictions in [[require]] and [[compare]]. What a figure asks of the reference is judged only
/// where the references are sound in themselves.
void check_measures(const Scenario& scenario, bool sound_references, base::Problems& out);

}  // namespace sixstep::study

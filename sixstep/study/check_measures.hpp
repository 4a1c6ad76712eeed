// SPDX-License-Identifier: Apache-2.0
// Which figure can be taken of which signal, in which mode and over which window.
#pragma once
#include "sixstep/base/problem.hpp"
#include "sixstep/study/scenario.hpp"

namespace sixstep::study {

/// All contradictions in [[require]] and [[compare]].
void check_measures(const Scenario& scenario, base::Problems& out);

}  // namespace sixstep::study

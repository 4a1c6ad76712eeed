// SPDX-License-Identifier: Apache-2.0
// Checks a [[compare]] that lays a recording over a signal.
#pragma once
#include <string>

#include "sixstep/base/problem.hpp"
#include "sixstep/study/scenario/scenario.hpp"

namespace sixstep::study {

/// `where`: place of the table. The window has been checked.
void check_recording(const LaidOver& laid, const std::string& where, const Scenario& scenario,
                     base::Problems& out);

}  // namespace sixstep::study

// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "sixstep/study/scenario/scenario.hpp"

namespace sixstep::analysis {

/// Shortens the numbers of a scenario for a reader. Times, limits and expectations are written with as few
/// digits as possible. Each is rounded in the direction in which a fulfilled requirement remains fulfilled.
void write_in_few_digits(study::Scenario& scenario);

}  // namespace sixstep::analysis

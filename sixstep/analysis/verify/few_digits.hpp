// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "sixstep/study/scenario/scenario.hpp"

namespace sixstep::analysis {

/// A scenario that a person is to read and change: its times, limits and expectations in as few digits as serve, each towards the side
/// on which what held still holds.
void write_in_few_digits(study::Scenario& scenario);

}  // namespace sixstep::analysis

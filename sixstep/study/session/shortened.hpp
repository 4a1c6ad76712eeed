// SPDX-License-Identifier: Apache-2.0
// Shortens a scenario.
#pragma once
#include "sixstep/study/scenario/scenario.hpp"

namespace sixstep::study {

/// The same run up to end_s, without later events. Figures are dropped if their window begins after end_s or
/// if they cannot be measured any more.
Scenario shortened(const Scenario& scenario, double end_s);

}  // namespace sixstep::study

// SPDX-License-Identifier: Apache-2.0
// Makes a scenario end sooner.
#pragma once
#include "sixstep/study/scenario/scenario.hpp"

namespace sixstep::study {

/// The same run up to end_s. Events from there on are dropped, and so are figures whose window begins after it
/// or that cannot be taken any more.
Scenario shortened(const Scenario& scenario, double end_s);

}  // namespace sixstep::study

// SPDX-License-Identifier: Apache-2.0
// A scenario that ends sooner.
#pragma once
#include "sixstep/study/scenario/scenario.hpp"

namespace sixstep::study {

/// The same run up to end_s. What would happen from there on is dropped, and so are figures whose window lies
/// behind it or that cannot be taken any more.
Scenario shortened(const Scenario& scenario, double end_s);

}  // namespace sixstep::study

// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "sixstep/study/compile/basis.hpp"

namespace sixstep::study {

/// The controller of a scenario that does not change it: loops, extras, and limits that it can keep.
base::Result<Tuned> tuned(const Scenario& scenario, const Basis& basis);

}  // namespace sixstep::study

// SPDX-License-Identifier: Apache-2.0
// Creates the observers of a run from its scenario and its listeners.
#pragma once
#include "sixstep/study/measure/observers.hpp"
#include "sixstep/study/run/run.hpp"

namespace sixstep::study {

/// `indices`: record_indices(scenario).
Observers observers_of(const Scenario& scenario, const Listeners& listeners,
                       const std::vector<std::size_t>& indices);

}  // namespace sixstep::study

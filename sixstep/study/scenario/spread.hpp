// SPDX-License-Identifier: Apache-2.0
// One drive out of a series: motor, supply and load as they stray, the controller as it was designed.
#pragma once
#include <cstdint>
#include <string_view>
#include <vector>

#include "sixstep/base/result.hpp"
#include "sixstep/study/scenario/scenario.hpp"

namespace sixstep::study {

/// Drive `number` of the series that scenario.spread describes: a pure function of its arguments. Each value
/// depends on the seed, the number and its own key, not on what else is spread or in which order.
///
/// - The controller stays the one designed for the values as written (Scenario::designed_for): its gains,
///   torque and current limits, the bus voltage it divides by. Gains placed anew on each motor would hide
///   what a spread costs.
/// - What the sheet leaves to be derived is derived once, from the values as written: friction does not
///   change because the torque constant does.
/// - Torque constant and back-EMF constant are one fact: where the sheet gives both, both change.
///
/// Assumes that check() found nothing. Below 2^48 each number is another drive.
Scenario varied(const Scenario& scenario, std::uint64_t seed, std::uint64_t number);

/// What the keys of scenario.spread came to in one of its drives, in the keys' units; NaN for one without a number.
std::vector<double> strayed_values(const Scenario& scenario, Scenario drive);

/// The scenario with one number strayed to x, in the key's unit: the controller stays as it was designed. Keys as scenario.spread
/// may have them; a Problem's `where` is the key.
base::Result<Scenario> strayed_to(const Scenario& scenario, std::string_view key, double x);

/// What is wrong with scenario.spread: keys that are none or cannot stray, a width given twice or not at all,
/// a value that could leave its key's range. `where` is the key's path: "spread[0].relative".
base::Problems check_spread(const Scenario& scenario);

}  // namespace sixstep::study

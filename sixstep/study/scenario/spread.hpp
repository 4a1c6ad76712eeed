// SPDX-License-Identifier: Apache-2.0
// Draws one drive of a series: motor, supply and load vary, the controller stays as designed.
#pragma once
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "sixstep/base/result.hpp"
#include "sixstep/study/scenario/scenario.hpp"

namespace sixstep::study {

/// Drive `number` of the series that scenario.spread describes: a pure function of its arguments. Each value
/// depends on the seed, the number and its own key, not on other spread keys or their order.
///
///   - The controller stays as designed for the values as written (Scenario::designed_for). This includes its
///     gains, its torque and current limits, and the bus voltage by which it divides. Gains designed anew for
///     each motor would hide the effect of a spread.
///   - Values that the sheet omits are computed once, from the values as written: friction does not change
///     with the torque constant.
///   - Torque constant and back-EMF constant are one quantity: if the sheet gives both, both change.
///
/// Requires that check() found nothing. Numbers below 2^48 give different drives.
Scenario varied(const Scenario& scenario, std::uint64_t seed, std::uint64_t number);

/// The values of scenario.spread's keys in `drive`, in the keys' units; NaN for a key without a number.
std::vector<double> strayed_values(const Scenario& scenario, Scenario drive);

/// A number that differs from drive to drive.
struct VaryingNumber {
  double value = 0.0;  ///< in the key's unit, derived from other keys where the scenario does not give it
  std::string unit;
};

/// The number at a key that scenario.spread allows; empty if the key is not allowed or has no value.
std::optional<VaryingNumber> varying_number(const Scenario& scenario, std::string_view key);

/// The scenario with one number set to x, in the key's unit; the controller stays as designed. Allowed are
/// the keys that scenario.spread allows. A Problem's `where` is the key.
base::Result<Scenario> strayed_to(const Scenario& scenario, std::string_view key, double x);

/// Finds errors in scenario.spread: unknown keys, keys that cannot vary, a width given twice or not at all, a
/// value that could leave its key's range. `where` is the key's path: "spread[0].relative".
base::Problems check_spread(const Scenario& scenario);

}  // namespace sixstep::study

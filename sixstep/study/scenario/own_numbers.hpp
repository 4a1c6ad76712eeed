// SPDX-License-Identifier: Apache-2.0
// The numbers with which a user's controller runs: the scenario's values, else the controller's presets.
#pragma once
#include <algorithm>
#include <cstdint>
#include <vector>

#include "sixstep/study/scenario/own.hpp"

namespace sixstep::study {

/// A number with which the controller runs.
struct UsedNumber {
  const sixstep_parameter* is = nullptr;
  double value = 0.0;
  bool preset = true;  ///< true: this is the controller's preset, because the scenario gives no value
};

/// All numbers in the controller's order; empty as long as the controller's file has not been loaded.
inline std::vector<UsedNumber> used_numbers(const Own& own) {
  std::vector<UsedNumber> used;
  for (std::uint32_t n = 0; own.loaded != nullptr && n < own.loaded->parameters; ++n) {
    const sixstep_parameter& is = own.loaded->parameter[n];
    const auto given = std::find_if(own.number.begin(), own.number.end(),
                                    [&is](const OwnNumber& number) { return number.name == is.name; });
    const bool preset = given == own.number.end();
    used.push_back({&is, preset ? is.preset : given->value, preset});
  }
  return used;
}

}  // namespace sixstep::study

// SPDX-License-Identifier: Apache-2.0
// A random scenario like an engineer's: a motor of the library or a random motor, and every mode, sensor,
// firmware, arithmetic and kind of event. Each key is within its limits.
#pragma once
#include <cstdint>
#include <string>

#include "sixstep/study/scenario/scenario.hpp"

namespace sixstep::testing {

struct DrawnScenario {
  study::Scenario scenario;
  std::string text;  ///< the text of the scenario file, with the random motor's values as overrides
};

/// A random scenario. Only the seed determines it.
DrawnScenario drawn_scenario(std::uint64_t seed);

}  // namespace sixstep::testing

// SPDX-License-Identifier: Apache-2.0
// A random scenario of the kind that an engineer writes: any motor of the library or a drawn one, every mode, sensor, firmware, arithmetic
// and kind of event. Each key is within the limits of its check.
#pragma once
#include <cstdint>
#include <string>

#include "sixstep/study/scenario/scenario.hpp"

namespace sixstep::testing {

struct DrawnScenario {
  study::Scenario scenario;
  std::string text;  ///< a file's text, with the drawn motor's values among its overrides
};

/// A scenario that the seed alone determines.
DrawnScenario drawn_scenario(std::uint64_t seed);

}  // namespace sixstep::testing

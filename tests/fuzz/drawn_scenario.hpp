// SPDX-License-Identifier: Apache-2.0
// A scenario drawn at random as an engineer might write one: any motor of the library or one that is drawn,
// every mode, sensor, firmware, arithmetic and kind of event, each key with the sense that its check asks
// for.
#pragma once
#include <cstdint>
#include <string>

#include "sixstep/study/scenario/scenario.hpp"

namespace sixstep::testing {

struct DrawnScenario {
  study::Scenario scenario;
  std::string text;  ///< as a file says it, the drawn motor's values among its overrides
};

/// The seed decides all of it.
DrawnScenario drawn_scenario(std::uint64_t seed);

}  // namespace sixstep::testing

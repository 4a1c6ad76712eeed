// SPDX-License-Identifier: Apache-2.0
// Sessions of the digest table: opened, changed while they run, closed; and what they wrote, run anew.
#pragma once
#include <string>
#include <vector>

#include "sixstep/study/session/session.hpp"

namespace sixstep::testing {

struct LivedCase {
  std::string name;
  base::Result<study::Outcome> outcome;
  study::Scenario written;  ///< whose run has the same digest
};

std::vector<LivedCase> lived_cases();

}  // namespace sixstep::testing

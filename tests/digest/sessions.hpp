// SPDX-License-Identifier: Apache-2.0
// Sessions of the digest table: opened, changed during the run and closed; and the run of the scenario that they wrote.
#pragma once
#include <string>
#include <vector>

#include "sixstep/study/session/session.hpp"

namespace sixstep::testing {

struct LivedCase {
  std::string name;
  base::Result<study::Outcome> outcome;
  study::Scenario written;  ///< the scenario that the session wrote; its run has the session's digest
};

std::vector<LivedCase> lived_cases();

}  // namespace sixstep::testing

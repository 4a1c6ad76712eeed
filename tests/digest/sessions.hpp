// SPDX-License-Identifier: Apache-2.0
// Sessions of the digest table. Each session is opened, changed during the run and closed. The table also
// contains the runs of the scenarios that the sessions write.
#pragma once
#include <string>
#include <vector>

#include "sixstep/study/session/session.hpp"

namespace sixstep::testing {

struct LivedCase {
  std::string name;
  base::Result<study::Outcome> outcome;
  study::Scenario written;  ///< the scenario that the session wrote; a run of it has the same digest as the
                            ///< session
};

std::vector<LivedCase> lived_cases();

}  // namespace sixstep::testing

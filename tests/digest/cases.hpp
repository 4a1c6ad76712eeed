// SPDX-License-Identifier: Apache-2.0
// The runs whose bits are compared between platforms. The name of a run never changes. After a run is changed
// or added, a new table is needed (tools/check_bits.sh --renew).
#pragma once
#include <string>
#include <vector>

#include "sixstep/study/scenario/scenario.hpp"

namespace sixstep::testing {

struct Case {
  std::string name;  ///< no spaces
  study::Scenario scenario;
};

std::vector<Case> digest_cases();

}  // namespace sixstep::testing

// SPDX-License-Identifier: Apache-2.0
// In which keys scenarios differ, by the description that also reads them.
#pragma once
#include <string>
#include <vector>

#include "sixstep/study/scenario/scenario.hpp"

namespace report {

struct KeyDifference {
  std::string key;                  ///< "control.current.settle_s"
  std::vector<std::string> values;  ///< of each scenario, with unit; "–" where it is not given
};

/// Titles, notes, what is recorded and what is required do not count: they do not change a run.
std::vector<KeyDifference> differences(const std::vector<const sixstep::study::Scenario*>& scenarios);

}  // namespace report

// SPDX-License-Identifier: Apache-2.0
// Finds the keys in which scenarios differ, by the same descriptions with which scenarios are read.
#pragma once
#include <string>
#include <vector>

#include "sixstep/study/scenario/scenario.hpp"

namespace report {

struct KeyDifference {
  std::string key;                  ///< path such as "control.current.settle_s"
  std::vector<std::string> values;  ///< value in each scenario, with unit; "–" if not given
};

/// The keys in which the scenarios differ. Titles, notes, recorded columns and requirements are ignored,
/// because they do not change a run.
std::vector<KeyDifference> differences(const std::vector<const sixstep::study::Scenario*>& scenarios);

}  // namespace report

// SPDX-License-Identifier: Apache-2.0
// Describes a scenario's surroundings, one line per part: supply, bridge, load, heat, sensors, and the
// changes during the run.
#pragma once
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "sixstep/study/scenario/scenario.hpp"

namespace report {

std::string supply(const sixstep::study::Supply& s);
std::string bridge(const sixstep::study::Bridge& b);
std::string shaft(const sixstep::study::Load& load, bool linear);
/// Empty if no temperature is simulated.
std::string heat(const sixstep::study::Heat& h);
std::string sensors(const sixstep::study::Sensors& s);
bool all_ideal(const sixstep::study::Sensors& s);
/// The first eight values, and the number of all values.
std::string listed(const std::vector<double>& values, const char* unit);
std::string events(const std::vector<sixstep::study::At>& events, bool linear);
/// Each key whose value is not its default and has no effect on `sentences`, with its value and unit. So
/// every key that no sentence states is listed, also a new key.
std::vector<std::pair<std::string, std::string>> other_keys(
    const sixstep::study::Scenario& scenario,
    const std::function<std::string(const sixstep::study::Scenario&)>& sentences);

}  // namespace report

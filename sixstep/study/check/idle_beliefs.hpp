// SPDX-License-Identifier: Apache-2.0
// Says which beliefs of [believed] a drive computes nothing with. Remarks on their costs and on keys without effect read it.
#pragma once
#include <string_view>

#include "sixstep/study/scenario/scenario.hpp"

namespace sixstep::study {

enum class Belief { sensor_offset, hall_lines, pole_pairs, winding, torque_constant, inertia };

/// Why this drive computes nothing with the belief; empty if it may.
std::string_view idle_belief(const Scenario& scenario, Belief belief);

}  // namespace sixstep::study

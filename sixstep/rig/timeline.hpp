// SPDX-License-Identifier: Apache-2.0
// What the scenario does to a run, as one sorted list of typed actions at known instants.
#pragma once
#include <cstddef>
#include <vector>

#include "sixstep/sim/instant.hpp"

namespace sixstep::rig {

enum class ActionKind : std::uint8_t { setpoint, load_torque, hall_stuck, run_request };

struct Action {
  sim::Instant at;
  ActionKind kind = ActionKind::setpoint;
  double value = 0.0;  ///< setpoint in the mode's unit; N m; Hall line 1 to 3, stuck low where negative;
                       ///< a request to run is raised (1) or let go (0)
};

/// Sorted by time, stable where times are equal.
using Timeline = std::vector<Action>;

}  // namespace sixstep::rig

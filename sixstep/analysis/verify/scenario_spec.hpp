// SPDX-License-Identifier: Apache-2.0
// A design for the board and the task of a scenario.
#pragma once
#include <optional>

#include "sixstep/design/loops/drive_design.hpp"
#include "sixstep/study/scenario/scenario.hpp"

namespace sixstep::analysis {

/// What the scenario says of the drive: mode, bus, PWM, delay, rotor sensor, load inertia, torque limit,
/// settling times, and the lowest speed that its reference asks for. What it leaves open stays the spec's
/// default; given gains are not looked at, since new ones are asked for. `mode`: another one than the scenario's is designed; each loop
/// keeps the settling time that the scenario gives it.
design::DesignSpec spec_of(const study::Scenario& scenario, std::optional<control::Mode> mode = {});

/// Controllers of the scenario that a design, which lays out PI loops, would pass over.
base::Problems passed_over(const study::Scenario& scenario);

/// How its drive knows the rotor: what [sensors] says, but that the product drive has Hall probes alone, and the sensorless one
/// crossings that count as their edges.
design::RotorSensing rotor_sensing_of(const study::Scenario& scenario);

}  // namespace sixstep::analysis

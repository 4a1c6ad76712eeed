// SPDX-License-Identifier: Apache-2.0
// Makes the specification of a design for a scenario's board and task.
#pragma once
#include <optional>

#include "sixstep/design/loops/drive_design.hpp"
#include "sixstep/study/scenario/scenario.hpp"

namespace sixstep::analysis {

/// Copies from the scenario: mode, bus, PWM, delay, rotor sensor, load inertia, torque limit, settling times,
/// and the lowest speed of its reference. All other members keep the spec's default. Given gains are ignored,
/// because the design computes new ones. `mode`: designs this mode instead of the scenario's; each loop keeps
/// the settling time that the scenario gives it.
design::DesignSpec spec_of(const study::Scenario& scenario, std::optional<control::Mode> mode = {});

/// Controllers of the scenario that a design ignores, because it computes PI loops only.
base::Problems passed_over(const study::Scenario& scenario);

/// Rotor sensor of the scenario's drive, as in [sensors]. But the product drive has Hall probes only, and the
/// sensorless drive has crossings that count as Hall edges.
design::RotorSensing rotor_sensing_of(const study::Scenario& scenario);

}  // namespace sixstep::analysis

// SPDX-License-Identifier: Apache-2.0
// Computes the specification of a design for a scenario's board and reference.
#pragma once
#include <optional>

#include "sixstep/design/loops/drive_design.hpp"
#include "sixstep/study/scenario/scenario.hpp"

namespace sixstep::analysis {

/// Copies from the scenario: mode, bus, PWM, delay, rotor sensor, load inertia, torque limit, settling times,
/// and the lowest speed of its reference. All other members have the spec's default. Given gains are ignored,
/// because the design computes new gains. `mode`: designs this mode instead of the scenario's mode; the
/// settling times of the scenario's loops are kept.
design::DesignSpec spec_of(const study::Scenario& scenario, std::optional<control::Mode> mode = {});

/// Controllers of the scenario that a design ignores, because it computes PI loops only.
base::Problems passed_over(const study::Scenario& scenario);

/// Rotor sensor of the scenario's drive, as in [sensors], with two exceptions: the product drive has Hall
/// probes only, and in the sensorless drive crossings count as Hall edges.
design::RotorSensing rotor_sensing_of(const study::Scenario& scenario);

}  // namespace sixstep::analysis

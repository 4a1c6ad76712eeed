// SPDX-License-Identifier: Apache-2.0
// What stopped a run, or a drive within a run, in words.
#pragma once
#include <optional>

#include "sixstep/base/problem.hpp"
#include "sixstep/rig/rig.hpp"

namespace sixstep::study {

/// The run ended at t_s: nothing sensible comes behind a shoot-through, or behind a lean drive that lost its
/// rotor.
base::Problem stopped_by(rig::Fault fault, const rig::Diagnosis& found, double t_s);

/// The product drive turned the bridge off and latched why; the motor coasted on. Empty: it did not.
std::optional<base::Problem> tripped_by(const rig::Diagnosis& found);

}  // namespace sixstep::study

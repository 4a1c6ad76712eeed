// SPDX-License-Identifier: Apache-2.0
// Decides which members of a spec a design reads: by mode, by method of the gains, and by the rotor's sensor.
// This file is the only definition; tests/analysis/spec_use_test.cpp checks every member for all modes,
// methods and sensors.
#pragma once
#include <optional>
#include <string_view>

#include "sixstep/base/problem.hpp"
#include "sixstep/design/loops/drive_design.hpp"

namespace sixstep::design {

/// The reason why a given member has no effect on this design, and what the member requires; empty if the
/// design reads the member. The problem names the member and contains no value.
std::optional<base::Problem> without_use(const DesignSpec& spec, std::string_view member);

}  // namespace sixstep::design

// SPDX-License-Identifier: Apache-2.0
// Which members of a spec a design reads: by mode, by method of the gains, and by the sensor of the rotor. The one place that says
// so; tests/analysis/spec_use_test.cpp walks every member through all of them.
#pragma once
#include <optional>
#include <string_view>

#include "sixstep/base/problem.hpp"
#include "sixstep/design/loops/drive_design.hpp"

namespace sixstep::design {

/// Why a member that somebody gave would change nothing of this design, and what it needs; empty where it is read. The problem
/// names the member and quotes no value.
std::optional<base::Problem> without_use(const DesignSpec& spec, std::string_view member);

}  // namespace sixstep::design

// SPDX-License-Identifier: Apache-2.0
// Members of a spec that a design reads: by mode, by method of the gains, and by the rotor's sensor. This is their
// only definition; tests/analysis/spec_use_test.cpp checks every member in all of them.
#pragma once
#include <optional>
#include <string_view>

#include "sixstep/base/problem.hpp"
#include "sixstep/design/loops/drive_design.hpp"

namespace sixstep::design {

/// Reason why a given member has no effect on this design, and what it requires; empty if the design reads it. The
/// problem names the member and has no value.
std::optional<base::Problem> without_use(const DesignSpec& spec, std::string_view member);

}  // namespace sixstep::design

// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "faces/cli/rooms.hpp"
#include "faces/cli/verb.hpp"
#include "sixstep/base/describe.hpp"
#include "sixstep/design/loops/drive_design.hpp"

namespace cli {

/// The words of --method.
inline constexpr base::Choice<design::GainMethod> method_choices[] = {
    {"pole-placement", design::GainMethod::pole_placement, "a pair of poles from settling time and damping"},
    {"cancellation", design::GainMethod::cancellation,
     "the PI's zero cancels the plant's pole; the bandwidth is free"},
    {"symmetrical-optimum", design::GainMethod::symmetrical_optimum,
     "speed loop: the largest phase margin for the lag of the current loop"},
};

/// `sixstep design MOTOR`: computes gains from the sheet and checks them by simulation.
Verb declare_design(CLI::App& app);

}  // namespace cli

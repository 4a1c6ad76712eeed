// SPDX-License-Identifier: Apache-2.0
// A run of a scenario with its drive on a core.
#pragma once
#include "faces/loop/cores.hpp"
#include "faces/loop/rooms.hpp"
#include "sixstep/study/run/run.hpp"

namespace loop {

/// What stands against it, before anything is compiled.
base::Problems stands_against(const Core& core, const study::Scenario& scenario);

/// study::run() with the drive on a core, too or in its place; null: on the host alone. No file is left of it. Problems: what stands
/// against it, a compiler's complaint, an emulator that is missing.
base::Result<study::Outcome> run(const Core* core, const study::Scenario& scenario,
                                 const study::Listeners& listeners);

}  // namespace loop

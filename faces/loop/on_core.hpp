// SPDX-License-Identifier: Apache-2.0
// Runs a scenario with its drive on a core.
#pragma once
#include "faces/loop/cores.hpp"
#include "faces/loop/rooms.hpp"
#include "sixstep/study/run/run.hpp"

namespace loop {

/// Reasons why the core cannot run the scenario, found before any compilation.
base::Problems stands_against(const Core& core, const study::Scenario& scenario);

/// Calls study::run() with the drive also on a core, or with a chip in place of the drive; if `core` is null,
/// only on the host. All temporary files are removed. Problems: the problems of stands_against(), an error of
/// the compiler, a missing emulator.
base::Result<study::Outcome> run(const Core* core, const study::Scenario& scenario,
                                 const study::Listeners& listeners);

}  // namespace loop

// SPDX-License-Identifier: Apache-2.0
// Which scenarios a core can run, each with what stands against it: one beside the host (rig/lockstep_core.hpp), which is flashed once and
// has one answer for a bridge; or the AVR in the drive's place (rig/chip_drive.hpp), whose board has a timer, a converter and three
// transducers, and no more.
#pragma once
#include "sixstep/base/problem.hpp"
#include "sixstep/study/scenario/scenario.hpp"

namespace sixstep::study {

/// What stands against it, each with its cure.
base::Problems not_on_a_core(const Scenario& scenario);
base::Problems not_on_an_avr(const Scenario& scenario);
/// Of a firmware that is none of ours: the board's converters alone.
base::Problems not_on_an_avrs_board(const Scenario& scenario);

}  // namespace sixstep::study

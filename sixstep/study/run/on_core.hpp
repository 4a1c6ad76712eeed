// SPDX-License-Identifier: Apache-2.0
// Finds reasons why a core cannot run a scenario.
// - One kind of core runs in parallel with the host (rig/lockstep_core.hpp); its program is fixed when it is
//   flashed.
// - The other is an AVR that replaces the drive (rig/chip_drive.hpp); its board has only a timer, a converter
//   and three current transducers.
#pragma once
#include "sixstep/base/problem.hpp"
#include "sixstep/study/scenario/scenario.hpp"

namespace sixstep::study {

/// The reasons against running the scenario on a core, each with a cure.
base::Problems not_on_a_core(const Scenario& scenario);
base::Problems not_on_an_avr(const Scenario& scenario);
/// The reasons against a user's firmware on the AVR's board; only the board's converters are checked.
base::Problems not_on_an_avrs_board(const Scenario& scenario);

}  // namespace sixstep::study

// SPDX-License-Identifier: Apache-2.0
// Checks designs on boards with one shunt, which measures a current only if the pulse lasts long enough. The
// usual test runs under load, with long pulses. This check covers currents with shorter pulses.
#pragma once
#include "sixstep/analysis/verify/design_study.hpp"

namespace sixstep::analysis {

/// The current in A below which one shunt measures nothing with the rotor at rest; 0 for other boards.
double unseen_current_A(const design::DriveDesign& design, const study::Scenario& scenario);

/// For a board with one shunt: warns of the currents that it does not measure with the rotor at rest. For a
/// speed loop, the function also runs the test without its load. The warning is grave in two cases: the step
/// of a current loop is below unseen_current_A(), or the speed's swing exceeds its limit.
void look_at_blind_shunt(const DesignOrder& order, DesignStudy& study);

}  // namespace sixstep::analysis

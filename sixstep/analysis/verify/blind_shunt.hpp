// SPDX-License-Identifier: Apache-2.0
// One shunt sees a current while a pulse lasts long enough. A design is tried under load; what it does below the shortest pulse that is
// seen is another question.
#pragma once
#include "sixstep/analysis/verify/design_study.hpp"

namespace sixstep::analysis {

/// The current that one shunt does not see with the rotor at rest, A; 0 of other boards.
double unseen_current_A(const design::DriveDesign& design, const study::Scenario& scenario);

/// Of a board with one shunt: warns which currents it does not see with the rotor at rest, and of a speed loop runs the test once more
/// without its load. Grave where the step of a current loop is below what is seen, or where the speed swings further than it may.
void look_at_blind_shunt(const DesignOrder& order, DesignStudy& study);

}  // namespace sixstep::analysis

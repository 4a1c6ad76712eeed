// SPDX-License-Identifier: Apache-2.0
// Creates a first scenario for a motor. The scenario runs and passes.
#pragma once
#include <optional>
#include <string>

#include "sixstep/analysis/verify/robust.hpp"
#include "sixstep/base/result.hpp"
#include "sixstep/design/sheet/sheet.hpp"
#include "sixstep/study/scenario/scenario.hpp"

namespace sixstep::analysis {

struct FirstScenarioSpec {
  control::Mode mode = control::Mode::speed;  ///< duty, current, speed or position
  std::string motor;                          ///< name or path, for the scenario
  design::Sheet sheet;                        ///< sheet of the motor
  std::optional<double> voltage_V;            ///< bus voltage; empty: nominal voltage of the sheet
  ForEach for_each = one_after_the_other;     ///< runs the motors within the tolerances
};

/// Creates the scenario. Problems: errors of the sheet; no design is usable.
/// - Current, speed, position: the design's own test (design_scenario.hpp) with a board's sensors. The
///   settling time is the design's settling time if the design is usable over the sheet's tolerances. Else it
///   is the shortest usable of 2, 5, 10 .. times this time.
/// - Duty: a run-up from rest at half the voltage. Chopping is complementary: the current is then continuous,
///   and the sheet's straight line predicts the speed w: 0 = K_t (d U - K_t w)/R_tt - B w - T_c, with the
///   mean voltage d U, the viscous friction B and the dry friction T_c.
base::Result<study::Scenario> first_scenario(const FirstScenarioSpec& spec);

}  // namespace sixstep::analysis

// SPDX-License-Identifier: Apache-2.0
// What a scenario's field-oriented drive comes to before it is run: its gains with where they come from, its loops with their
// margins, and what bus and currents allow. Closed form, of the gains that the run itself has.
#pragma once
#include <vector>

#include "sixstep/design/loops/drive_design.hpp"
#include "sixstep/design/loops/field_current.hpp"
#include "sixstep/study/scenario/scenario.hpp"

namespace sixstep::analysis {

struct FieldStudy {
  study::Scenario scenario;
  design::FieldMachine machine;
  /// Loops from the inside out, "current d" and "current q" where the rotor is salient, else "current"; bus, torque limit and the
  /// current at it; the speed's sensor. What only a driven pair has stays empty.
  design::DriveDesign design;
  std::vector<design::DerivationStep> axes;    ///< torque, decoupling, angle, weakening
  std::vector<design::DerivationStep> limits;  ///< what the circle of the bus lets through
  std::vector<design::Warning> warnings;

  bool usable() const;  ///< no warning is grave
};

/// Problems: those of the scenario, and that its drive is another.
base::Result<FieldStudy> study_field(const study::Scenario& scenario);

}  // namespace sixstep::analysis

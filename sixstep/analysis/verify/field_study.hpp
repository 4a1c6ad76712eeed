// SPDX-License-Identifier: Apache-2.0
// Computes the figures of a scenario's field-oriented drive without a run: its gains with their origin, its loops
// with their margins, and the limits of bus and currents. All are closed forms of the gains that the run itself
// has.
#pragma once
#include <vector>

#include "sixstep/design/loops/drive_design.hpp"
#include "sixstep/design/loops/field_current.hpp"
#include "sixstep/study/scenario/scenario.hpp"

namespace sixstep::analysis {

struct FieldStudy {
  study::Scenario scenario;
  design::FieldMachine machine;
  /// Loops from the inside out, "current d" and "current q" where the rotor is salient, else "current"; bus,
  /// torque limit and the current at it; the speed's sensor. Members that only a driven pair has stay empty.
  design::DriveDesign design;
  std::vector<design::DerivationStep> axes;    ///< torque, decoupling, angle, weakening
  std::vector<design::DerivationStep> limits;  ///< speeds and torque that the bus's voltage circle allows
  std::vector<design::Warning> warnings;

  bool usable() const;  ///< no warning is grave
};

/// Problems: those of the scenario; a drive that is not field-oriented or has no linear loop.
base::Result<FieldStudy> study_field(const study::Scenario& scenario);

}  // namespace sixstep::analysis

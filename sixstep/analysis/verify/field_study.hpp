// SPDX-License-Identifier: Apache-2.0
// Computes the figures of a scenario's field-oriented drive without a run: gains with their origin, loops
// with their margins, and the limits of bus and currents. All figures follow in closed form from the gains of
// the run.
#pragma once
#include <vector>

#include "sixstep/design/loops/drive_design.hpp"
#include "sixstep/design/loops/field_current.hpp"
#include "sixstep/study/scenario/scenario.hpp"

namespace sixstep::analysis {

struct FieldStudy {
  study::Scenario scenario;
  design::FieldMachine machine;    ///< as the drive believes it
  design::FieldMachine simulated;  ///< the motor itself, to which the limits by the bus belong
  plant::Shaft simulated_shaft;    ///< with the load
  /// The loops from the inside out: "current d" and "current q" if the rotor is salient, else "current". Also
  /// bus, torque limit with its current, and the speed's sensor. Members for a driven pair stay empty.
  design::DriveDesign design;
  std::vector<design::DerivationStep> axes;  ///< derivation of torque, decoupling, angle and field weakening
  std::vector<design::DerivationStep> limits;  ///< derivation of the speeds and the torque within the bus's
                                               ///< voltage circle
  std::vector<std::string> beliefs;            ///< cost of each wrong belief (study/run/belief_costs.hpp)
  std::vector<design::Warning> warnings;

  bool usable() const;  ///< true: no warning is grave
};

/// Problems: errors of the scenario; a drive that is not field-oriented, or that has no linear loop.
base::Result<FieldStudy> study_field(const study::Scenario& scenario);

}  // namespace sixstep::analysis

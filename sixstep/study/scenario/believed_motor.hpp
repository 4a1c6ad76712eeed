// SPDX-License-Identifier: Apache-2.0
// The motor as the drive believes it. All numbers of a controller follow from this motor. All numbers of the
// plant follow from Scenario::sheet.
#pragma once
#include "sixstep/base/result.hpp"
#include "sixstep/design/sheet/parameters.hpp"
#include "sixstep/study/scenario/scenario.hpp"

namespace sixstep::study {

/// The sheet with the believed values. A value replaces all forms of the same constant. A value without a
/// frame has the frame of the sheet's value.
design::Sheet believed_sheet(design::Sheet sheet, const Believed& believed);

/// The sheet on which the scenario's controller is designed: the sheet of its motor, or of the nominal motor
/// of a series, with the believed values.
design::Sheet believed_sheet(const Scenario& scenario);

/// The model of this sheet. Problems of a believed value name its key: "believed.inductance_mH".
base::Result<design::MotorModel> believed_motor(const Scenario& scenario);

/// True if a value of the motor is believed, right or wrong.
bool believes_a_motor(const Believed& believed);

}  // namespace sixstep::study

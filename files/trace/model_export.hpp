// SPDX-License-Identifier: Apache-2.0
// Exports the thesis's two state spaces at a rotor angle, for Octave, MATLAB and Python.
#pragma once
#include <string>

#include "files/rooms.hpp"
#include "sixstep/design/sheet/parameters.hpp"

namespace files {

/// The angle is the whole operating point, because the models are linear in their states at a given angle.
struct ModelPoint {
  const design::MotorModel& motor;
  double electrical_deg = 30.0;  ///< 30: the middle of sector 0, a and b on their flat tops
};

/// {"parameters": .., "phase_voltage": {"A": rows, "B": rows, "states": .., "inputs": ..},
/// "terminal_voltage": ..}
std::string models_json(const ModelPoint& point);

/// The same as a MAT file of version 5: phase_A, phase_B, terminal_A, terminal_B, the parameters by name, and
/// the states and inputs as text. The same input gives the same bytes: no date.
std::string models_mat(const ModelPoint& point);

}  // namespace files

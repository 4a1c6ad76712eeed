// SPDX-License-Identifier: Apache-2.0
// Exports the two state-space models of the thesis at a rotor angle, for Octave, MATLAB and Python.
#pragma once
#include <string>

#include "files/rooms.hpp"
#include "sixstep/design/sheet/parameters.hpp"

namespace files {

/// The operating point of the models. It is defined by the angle only, because at a given angle the models
/// are linear in their states.
struct ModelPoint {
  const design::MotorModel& motor;
  double electrical_deg = 30.0;  ///< 30 degrees: the middle of sector 0, where a and b are on their flat tops
};

/// The models as JSON: {"parameters": .., "phase_voltage": {"A": rows, "B": rows, "states": .., "inputs":
/// ..}, "terminal_voltage": ..}
std::string models_json(const ModelPoint& point);

/// The models as a MAT file of version 5: phase_A, phase_B, terminal_A, terminal_B, the parameters by name,
/// and the names of states and inputs as text. The same input gives the same bytes; the file contains no
/// date.
std::string models_mat(const ModelPoint& point);

}  // namespace files

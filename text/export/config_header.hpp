// SPDX-License-Identifier: Apache-2.0
// A scenario's drive as a C++ header for firmware: the bits that the simulation computes with, as constants;
// where the chip runs the product drive, all that stands around the loops too.
#pragma once
#include <optional>
#include <string>

#include "sixstep/base/result.hpp"
#include "sixstep/design/scaling/scaling.hpp"
#include "sixstep/study/run/export_gate.hpp"
#include "sixstep/study/scenario/scenario.hpp"
#include "text/rooms.hpp"

namespace text {

struct ConfigHeader {
  const study::Scenario& scenario;
  std::optional<study::Arithmetic> arithmetic;  ///< else the scenario's
  /// Fixed point: over what the drive is proved. Members that are 0 are study::operating_range's; with none
  /// stated, the bits are those of the scenario's run, control.full_scale included.
  design::OperatingRange range;
  std::string name_space;      ///< what the header declares is in it; a C++ name
  bool single_header = false;  ///< includes sixstep_control.hpp, not sixstep/control/
  std::string command;         ///< what makes this header again
  /// What its run has shown, which the header states; without one it says that nothing has.
  const study::Clearance* clearance = nullptr;
  std::string despite;  ///< why it is written although it is not clear
};

/// The header's text. Problems: a scenario without a drive (mode off), and what does not fit the fixed-point
/// format, as design::scaled names it.
base::Result<std::string> config_header(const ConfigHeader& wanted);

}  // namespace text

// SPDX-License-Identifier: Apache-2.0
// Writes a scenario's drive as a C++ header for firmware. Its constants have the same bits as in the
// simulation. If the chip runs the product drive, the header also configures monitoring, start and stop.
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
  std::optional<study::Arithmetic> arithmetic;  ///< empty: arithmetic of the scenario
  /// Fixed point: the operating range for which the drive is proved. A member that is 0 comes from
  /// study::operating_range. If no member is given, the constants have the same bits as in the scenario's
  /// run, including the full scales of control.full_scale.
  design::OperatingRange range;
  std::string name_space;  ///< C++ namespace of the declarations
  bool single_header =
      false;            ///< true: includes sixstep_control.hpp; false: includes headers of sixstep/control/
  std::string command;  ///< the command that makes this header again
  /// Results of the run, which the header's comment states; null: the comment says that there are none.
  const study::Clearance* clearance = nullptr;
  std::string despite;  ///< the reason for writing the header although the drive is not cleared
};

/// Returns the header's text. Problems: the scenario has no drive (mode off), or a value does not fit the
/// fixed-point format (the Problem names it as design::scaled does).
base::Result<std::string> config_header(const ConfigHeader& wanted);

}  // namespace text

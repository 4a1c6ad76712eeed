// SPDX-License-Identifier: Apache-2.0
// Writes the part of an exported header's comment that describes its run: requirements, measured values and
// assumptions. If the drive is not cleared, this part says why, and why the header was written nevertheless.
#pragma once
#include <string>
#include <string_view>

#include "sixstep/study/run/export_gate.hpp"
#include "sixstep/study/scenario/scenario.hpp"
#include "text/rooms.hpp"

namespace text {

struct ClearanceText {
  const study::Scenario& scenario;    ///< scenario of the run
  const study::Clearance* clearance;  ///< null: the scenario was not run
  std::string_view despite;           ///< the reason for writing the header although the drive is not cleared
  bool other_scale = false;           ///< true: fixed point, and header and run have different full scales
};

/// Lines of // comment, without a date: the same run gives the same lines.
std::string clearance_lines(const ClearanceText& text);

}  // namespace text

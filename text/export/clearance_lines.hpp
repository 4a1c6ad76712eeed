// SPDX-License-Identifier: Apache-2.0
// What a header says of the run behind it: what was required and measured, and what that run took for
// granted; or what stood against writing it, and why it was written all the same.
#pragma once
#include <string>
#include <string_view>

#include "sixstep/study/run/export_gate.hpp"
#include "sixstep/study/scenario/scenario.hpp"
#include "text/rooms.hpp"

namespace text {

struct ClearanceText {
  const study::Scenario& scenario;    ///< as it was run
  const study::Clearance* clearance;  ///< null: nobody ran it
  std::string_view despite;           ///< why it is written although it is not clear
  bool other_scale = false;           ///< fixed point: the header's full scale is not that of the run
};

/// Lines of // comment, without a date: the same run gives the same lines.
std::string clearance_lines(const ClearanceText& text);

}  // namespace text

// SPDX-License-Identifier: Apache-2.0
// The keys of a scenario file: the descriptions beside it are the only place of their names, units, ranges and meanings. Defaults are
// the structs'.
#pragma once
#include "sixstep/base/visitor.hpp"
#include "sixstep/study/scenario/scenario.hpp"

namespace sixstep::study {

/// Keys of the motor's sheet and of the timeline, which some visitors take apart from the others.
inline constexpr std::string_view sheet_table = "motor_override", events_list = "at";

void describe(base::Visitor& v, Scenario& s);

}  // namespace sixstep::study

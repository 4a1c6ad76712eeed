// SPDX-License-Identifier: Apache-2.0
// The keys of a scenario file. Only the descriptions in this folder define their names, units, ranges and
// meanings. The structs define the defaults.
#pragma once
#include "sixstep/base/visitor.hpp"
#include "sixstep/study/scenario/scenario.hpp"

namespace sixstep::study {

/// Names of two tables that some visitors handle separately: the motor's sheet and the events.
inline constexpr std::string_view sheet_table = "motor_override", events_list = "at";

void describe(base::Visitor& v, Scenario& s);

}  // namespace sixstep::study

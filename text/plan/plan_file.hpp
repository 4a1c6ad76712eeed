// SPDX-License-Identifier: Apache-2.0
// Reads a plan, the list of a scenario's runs, from a file or from command-line words.
#pragma once
#include <string>
#include <string_view>

#include "sixstep/analysis/plan/plan.hpp"
#include "sixstep/base/result.hpp"
#include "text/rooms.hpp"

namespace text {

struct PlanFile {
  std::string title, notes;
  std::string scenario;  ///< path as written
  bool sheet_tolerances = false;
  std::string minimise;  ///< label of the figure to minimise; empty: nothing is optimised
  std::size_t evaluations = 0;
  analysis::Plan plan;
};

/// Whether the text is a plan and not a scenario: it names a scenario and has no key of a scenario.
bool is_plan(const std::string& text);

/// Reads a plan. The `where` of each Problem begins with "file:line:column: ".
base::Result<PlanFile> read_plan_text(const std::string& name, std::string text);

/// Reads an axis from words such as "pwm.period_s=20us:100us:9", "load.torque_Nm=0.01:1:5:log" or
/// "pwm.chopping=soft,hard". A range without a number of points has only its ends, between which points are
/// drawn. A Problem's `where` is the text itself.
base::Result<analysis::Axis> axis_of(std::string_view text);

/// The unit of a scenario's key in this spelling, also inside a list: "at[0].load.torque_Nm". Problem: an
/// unknown key.
base::Result<std::string> unit_of_key(const std::string& key);

/// The plan as one line of JSON, by which two plans are compared. The number of runs is omitted if no single
/// run depends on it.
std::string plan_identity(const analysis::Plan& plan);

}  // namespace text

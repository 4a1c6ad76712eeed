// SPDX-License-Identifier: Apache-2.0
// Which runs are to be made of a scenario, as a file says it or a few words do.
#pragma once
#include <string>
#include <string_view>

#include "sixstep/analysis/plan/plan.hpp"
#include "sixstep/base/result.hpp"
#include "text/rooms.hpp"

namespace text {

struct PlanFile {
  std::string title, notes;
  std::string scenario;  ///< as written
  bool sheet_tolerances = false;
  std::string minimise;  ///< a figure's label; empty: nothing is optimised
  std::size_t evaluations = 0;
  analysis::Plan plan;
};

/// Whether the text is a plan's rather than a scenario's: it names one and has none of its keys.
bool is_plan(const std::string& text);

/// Each Problem's `where` begins with "file:line:column: ".
base::Result<PlanFile> read_plan_text(const std::string& name, std::string text);

/// "pwm.period_s=20us:100us:9", "load.torque_Nm=0.01:1:5:log", "pwm.chopping=soft,hard"; of a range without a number of
/// points its ends alone, for what is drawn between them. A Problem's `where` is the text itself.
base::Result<analysis::Axis> axis_of(std::string_view text);

/// The unit of a scenario's key as it is spelled, also of a list's: "at[0].load.torque_Nm"; a Problem for what is none.
base::Result<std::string> unit_of_key(const std::string& key);

/// The plan as one line of JSON: what two plans are compared by. Where runs do not depend on how many follow, that is left out.
std::string plan_identity(const analysis::Plan& plan);

}  // namespace text

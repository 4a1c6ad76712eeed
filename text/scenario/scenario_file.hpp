// SPDX-License-Identifier: Apache-2.0
// TOML in, typed data or every complaint about it out.
#pragma once
#include <string>
#include <vector>

#include "sixstep/base/result.hpp"
#include "sixstep/design/sheet/sheet.hpp"
#include "sixstep/study/scenario/scenario.hpp"
#include "text/sources.hpp"
#include "text/toml/document.hpp"

namespace text {

struct ReadOptions {
  std::vector<Setting> overrides;  ///< from the command line, stronger than the file
  Resolve resolve;                 ///< finds what the text names; motors compiled in need none
};

/// Scenario and its motor's sheet, checked to the last rule of study::check. Each Problem's `where` begins
/// with "file:line:column: " or "--set key", in the order of the lines. Messages call the text `name`.
base::Result<study::Scenario> read_scenario_text(const std::string& name, std::string text,
                                                 const ReadOptions& options = {});

/// A motor as find_motor() finds it.
base::Result<design::Sheet> read_sheet(const std::string& name, const Resolve& resolve = {});

}  // namespace text

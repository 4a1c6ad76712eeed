// SPDX-License-Identifier: Apache-2.0
// Reads a scenario or a motor from TOML, or reports everything that is wrong with it.
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
  std::vector<Setting> overrides;  ///< settings of the command line, which override the file
  Resolve resolve;                 ///< finds the named texts; motors compiled in do not need it
};

/// Reads the scenario with its motor's sheet, after all checks of study::check. The `where` of each Problem
/// begins with "file:line:column: " or "--set key". Problems are in the order of the lines. `name` is the
/// text's name in messages.
base::Result<study::Scenario> read_scenario_text(const std::string& name, std::string text,
                                                 const ReadOptions& options = {});

/// The sheet of a motor that find_motor() finds.
base::Result<design::Sheet> read_sheet(const std::string& name, const Resolve& resolve = {});

}  // namespace text

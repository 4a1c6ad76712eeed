// SPDX-License-Identifier: Apache-2.0
// TOML files in, typed data or every complaint about them out.
#pragma once
#include <string>
#include <vector>

#include "sixstep/base/result.hpp"
#include "sixstep/design/sheet/sheet.hpp"
#include "sixstep/study/scenario/scenario.hpp"
#include "text/rooms.hpp"
#include "text/toml/document.hpp"

namespace text {

struct ReadOptions {
  std::string data_dir;            ///< holds motors/; empty: none
  std::vector<Setting> overrides;  ///< from the command line, stronger than the file
};

/// Scenario and its motor's sheet, checked to the last rule of study::check. Each Problem's `where` begins
/// with "file:line:column: " or "--set key", in the order of the lines.
base::Result<study::Scenario> read_scenario(const std::string& path, const ReadOptions& options = {});

/// The same from a text at hand; messages call it `path`, and motors are looked for beside that.
base::Result<study::Scenario> read_scenario_text(const std::string& path, std::string text,
                                                 const ReadOptions& options = {});

/// A motor by path or name. `data_dir` as above.
base::Result<design::Sheet> read_sheet(const std::string& name, const std::string& data_dir = {});

}  // namespace text

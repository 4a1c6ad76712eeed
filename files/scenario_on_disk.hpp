// SPDX-License-Identifier: Apache-2.0
// Reads scenarios and motors by path, with the files that they refer to.
#pragma once
#include <string>
#include <vector>

#include "files/rooms.hpp"
#include "text/scenario/scenario_file.hpp"

namespace files {

/// A Resolve that searches a named file in the folder of the file that names it. Motors are also searched in
/// the data folder, as motors/NAME.toml.
text::Resolve on_disk(const std::string& data_dir = {});

struct ReadOptions {
  std::string data_dir;                  ///< folder with motors/; empty: none
  std::vector<text::Setting> overrides;  ///< settings of the command line, which override the file
};

/// Reads the file, then calls text::read_scenario_text().
base::Result<study::Scenario> read_scenario(const std::string& path, const ReadOptions& options = {});

/// Like read_scenario(), for a given text. `path` is the text's name in messages; named files are searched
/// relative to it.
base::Result<study::Scenario> read_scenario_text(const std::string& path, std::string text,
                                                 const ReadOptions& options = {});

/// Reads a motor's sheet by path or name.
base::Result<design::Sheet> read_sheet(const std::string& name, const std::string& data_dir = {});

}  // namespace files

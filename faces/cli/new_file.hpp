// SPDX-License-Identifier: Apache-2.0
// Writes new files for the user to edit.
#pragma once
#include <string>

#include "faces/cli/rooms.hpp"
#include "sixstep/base/problem.hpp"

namespace cli {

/// The file name for `name`, with .toml appended if it has no extension.
std::string toml_path(const std::string& name);

/// Returns a Problem if a file of that name exists.
base::Problems taken(const std::string& path);

/// Writes a new, complete file. Never replaces an existing file.
base::Problems write_new(const std::string& path, const std::string& text);

/// The motor's path relative to the folder of the scenario `toml`. The name of a built-in motor is unchanged.
std::string motor_beside(const std::string& motor, const std::string& toml);

}  // namespace cli

// SPDX-License-Identifier: Apache-2.0
// Files that are made once and then belong to the user.
#pragma once
#include <string>

#include "faces/cli/rooms.hpp"
#include "sixstep/base/problem.hpp"

namespace cli {

/// `name` as the file's name: with .toml behind it where it has none.
std::string toml_path(const std::string& name);

/// Told where something of that name is there already.
base::Problems taken(const std::string& path);

/// Writes it whole, and never over what is there.
base::Problems write_new(const std::string& path, const std::string& text);

/// A motor given by path as a scenario at `toml` has to name it; a built-in's name stays as it is.
std::string motor_beside(const std::string& motor, const std::string& toml);

}  // namespace cli

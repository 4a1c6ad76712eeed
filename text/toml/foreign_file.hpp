// SPDX-License-Identifier: Apache-2.0
// Recognises another program's parameter file in the place of a TOML file: names the program and the
// equivalent lines.
#pragma once
#include <optional>
#include <string>
#include <string_view>

#include "sixstep/base/problem.hpp"
#include "text/rooms.hpp"

namespace text {

/// A Problem for a VESC motor configuration, an ODrive or moteus configuration, a SimpleFOC sketch or a
/// MATLAB pmsm struct; else empty.
std::optional<base::Problem> foreign_file(const std::string& name, std::string_view text);

}  // namespace text

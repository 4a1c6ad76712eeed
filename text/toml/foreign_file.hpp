// SPDX-License-Identifier: Apache-2.0
// The parameter file of another program where a TOML file is wanted: what it is, and which lines say the same here.
#pragma once
#include <optional>
#include <string>
#include <string_view>

#include "sixstep/base/problem.hpp"
#include "text/rooms.hpp"

namespace text {

/// Of a VESC motor configuration, an ODrive or moteus configuration, a SimpleFOC sketch or a MATLAB pmsm struct; none of other texts.
std::optional<base::Problem> foreign_file(const std::string& name, std::string_view text);

}  // namespace text

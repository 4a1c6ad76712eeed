// SPDX-License-Identifier: Apache-2.0
// Options for a number with a unit, written as in a scenario: "--period 25us".
#pragma once
#include <CLI/Option.hpp>

#include <string>

#include "faces/cli/rooms.hpp"

namespace cli {

/// Makes an option convert its text into `unit`. A text that is not a number with a suitable unit is
/// unchanged; the option's own check then refuses it.
CLI::Option* take_unit(CLI::Option* option, std::string unit);

}  // namespace cli

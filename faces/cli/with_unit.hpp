// SPDX-License-Identifier: Apache-2.0
// Options for a number with its unit, like the keys of a scenario: "--period 25us".
#pragma once
#include <CLI/Option.hpp>

#include <string>

#include "faces/cli/rooms.hpp"

namespace cli {

/// Makes an option convert its text into `unit`. A text that is no number with a fitting unit is unchanged,
/// and the option's own check refuses it.
CLI::Option* take_unit(CLI::Option* option, std::string unit);

}  // namespace cli

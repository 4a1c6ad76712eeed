// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "faces/cli/verb.hpp"

namespace cli {

/// `sixstep motor`, with these subcommands:
///   list        the built-in motors
///   show        one sheet with its model
///   check       the check of a sheet; `failed` if the sheet contradicts itself
///   new         a template to fill in
///   wiring      the 36 ways to connect a motor (wiring_command.hpp)
///   commission  the measurement of a connected motor (commission_command.hpp)
Verb declare_motor(CLI::App& app);

}  // namespace cli

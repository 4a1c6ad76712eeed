// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "faces/cli/verb.hpp"

namespace cli {

/// `sixstep motor list|show|check|new|wiring|commission`: the motors compiled in; one sheet with its model;
/// the check of a sheet (`failed` if the sheet contradicts itself); a template to fill in; the 36 ways to
/// connect a motor; the measurement of a connected motor (wiring_command.hpp, commission_command.hpp).
Verb declare_motor(CLI::App& app);

}  // namespace cli

// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <string>

#include "faces/cli/exit_code.hpp"

namespace cli {

/// `sixstep motor list`: names of the motors compiled in.
Exit list_motors();

/// `sixstep motor show NAME`: the sheet with unit, frame and source of each value.
Exit show_motor(const std::string& name, const std::string& data_dir);

}  // namespace cli

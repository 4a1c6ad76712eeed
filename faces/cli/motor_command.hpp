// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <string>

#include "faces/cli/exit_code.hpp"

namespace cli {

struct MotorArguments {
  std::string name;      ///< a path or a built-in name
  std::string data_dir;  ///< holds motors/
  std::string style = "maxon";
  bool json = false;
};

/// `sixstep motor list`: one line per motor compiled in.
Exit list_motors();

/// `sixstep motor show NAME`: the sheet as printed and the model that it makes.
Exit show_motor(const MotorArguments& a);

/// `sixstep motor check NAME`: the sheet held against itself. `failed` where it contradicts itself.
Exit check_motor(const MotorArguments& a);

/// `sixstep motor new [NAME]`: a template, to NAME.toml or to standard output. No file is overwritten.
Exit new_motor(const MotorArguments& a);

}  // namespace cli

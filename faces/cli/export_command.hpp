// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <string>
#include <vector>

#include "faces/cli/exit_code.hpp"

namespace cli {

struct ExportArguments {
  std::string file;                 ///< the scenario
  std::string out;                  ///< empty: standard output
  std::string arithmetic;           ///< empty: the scenario's
  std::vector<std::string> ranges;  ///< "current_A=20"
  std::vector<std::string> sets;    ///< "key=value"
  std::string name_space = "exported";
  std::string data_dir;
  bool single_header = false;
  std::string command;  ///< the command line as it may be typed again
};

/// `sixstep export header SCENARIO`: the scenario's drive as constants for firmware.
Exit export_header(const ExportArguments& arguments);

}  // namespace cli

// SPDX-License-Identifier: Apache-2.0
// Lists the cores that can run a drive, each with its compiler and its emulator. These are separate programs,
// called as processes and not linked.
#pragma once
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace loop {

struct Core {
  std::string_view name;              ///< name on the command line
  std::string_view title;             ///< name in texts
  std::vector<std::string> compiler;  ///< command with the flags of this core
  std::vector<std::string> emulator;  ///< command with its board; the image's path is appended
  std::string_view start_up;          ///< the code before main(), a file of faces/firmware/bare/
  std::string_view linker_script;     ///< a file of the same folder
  std::vector<std::string> libraries;
  bool by_registers = false;          ///< a whole chip in place of the drive; false: a core that is called
  std::vector<std::string> linker{};  ///< if the compiler does not link
  std::string elf{};                  ///< an existing program of the user; empty: ours is compiled
  double setpoint_range = 0.0;        ///< setpoint at the ends of the potentiometer, in the mode's unit
};

std::span<const Core> cores();

}  // namespace loop

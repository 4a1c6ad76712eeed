// SPDX-License-Identifier: Apache-2.0
// Lists the cores that can run a drive, each with its compiler and its emulator. Compilers and emulators are
// separate programs, called as processes and not linked.
#pragma once
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace loop {

struct Core {
  std::string_view name;              ///< name on the command line
  std::string_view title;             ///< name in texts
  std::vector<std::string> compiler;  ///< compiler command with the flags of this core
  std::vector<std::string> emulator;  ///< emulator command with its board; the image's path is appended
  std::string_view start_up;          ///< file of faces/firmware/bare/ with the code before main()
  std::string_view linker_script;     ///< linker script, a file of the same folder
  std::vector<std::string> libraries;
  bool by_registers = false;  ///< true: a whole chip replaces the drive; false: the host calls the core
  std::vector<std::string> linker{};  ///< linker command, if the compiler does not link
  std::string elf{};                  ///< path of a user's program; empty: the library's program is compiled
  double setpoint_range = 0.0;        ///< setpoint at the ends of the potentiometer, in the mode's unit
};

std::span<const Core> cores();

}  // namespace loop

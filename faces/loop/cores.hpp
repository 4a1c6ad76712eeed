// SPDX-License-Identifier: Apache-2.0
// The cores that a drive can run on, each with its compiler and its emulator: programs of their own, called as processes and linked to
// nothing.
#pragma once
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace loop {

struct Core {
  std::string_view name;              ///< as it is asked for
  std::string_view title;             ///< as people call it
  std::vector<std::string> compiler;  ///< with the flags of this core
  std::vector<std::string> emulator;  ///< with its board; the image's path follows
  std::string_view start_up;          ///< what stands before main(), a file of faces/firmware/bare/
  std::string_view linker_script;     ///< likewise
  std::vector<std::string> libraries;
  bool by_registers = false;          ///< a whole chip in the drive's place, else a core that is called
  std::vector<std::string> linker{};  ///< where it is not the compiler
  std::string elf{};                  ///< a program that is there already, and none of ours
  double setpoint_range = 0.0;        ///< of its potentiometer, in the mode's unit
};

std::span<const Core> cores();

}  // namespace loop

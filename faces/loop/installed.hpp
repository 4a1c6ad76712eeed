// SPDX-License-Identifier: Apache-2.0
// Finds installed files: the sources for a program on a core, the AVR board, and the binary of a functional
// mock-up unit. It searches relative to the program's path, so that an installation can be moved.
#pragma once
#include <filesystem>
#include <string>

namespace loop {

/// The folder with sixstep/ and faces/, from which a core's program is compiled. In this order:
/// SIXSTEP_SOURCES, the sources of the build, the installed sources. If all sources are missing: empty, or a
/// folder without sources.
std::filesystem::path sources_folder();

/// The path of the program that emulates the ATmega2560's board. Only the name if the program must be on
/// PATH.
std::string avr_board_program();

/// The shared object of functional mock-up units for a version of FMI. Empty: it is not installed.
std::string unit_binary(int fmi);

}  // namespace loop

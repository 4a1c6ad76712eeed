// SPDX-License-Identifier: Apache-2.0
// What this program needs beside itself to run a drive on a core. It looks from where it lies, so that it may be installed anywhere,
// and moved.
#pragma once
#include <filesystem>
#include <string>

namespace loop {

/// The folder with sixstep/ and faces/ that a core's program is compiled from: SIXSTEP_SOURCES, else what was installed, else the
/// sources of a build. A folder without them, or empty: there are none.
std::filesystem::path sources_folder();

/// The ATmega2560's board; its name alone where it has to be on PATH.
std::string avr_board_program();

}  // namespace loop

// SPDX-License-Identifier: Apache-2.0
// Reads a map: the TOML file named by `sixstep run --on FILE`, with a user's own firmware and its connections
// to the board.
#pragma once
#include <string>
#include <vector>

#include "sixstep/base/result.hpp"
#include "text/rooms.hpp"

namespace text {

/// Pins as the data sheet names them, "PK0"; legs in the order a, b, c.
struct FirmwareMap {
  std::string elf;                ///< path relative to the map's folder, unless it is absolute
  std::vector<std::string> hall;  ///< pins of H1 H2 H3
  std::vector<std::string> upper, lower;
  std::vector<int> currents;  ///< input numbers of the converter
  int potentiometer = 3;      ///< input number of the converter
  double setpoint_range = 1.0;
};

/// Reads a map. `name` is the file's name in messages. Problems: all mistakes of the file.
base::Result<FirmwareMap> read_firmware_map(const std::string& name, std::string text);

}  // namespace text

// SPDX-License-Identifier: Apache-2.0
// A firmware of one's own and how it hangs at the board: a TOML file that `sixstep run --on FILE` names.
#pragma once
#include <string>
#include <vector>

#include "sixstep/base/result.hpp"
#include "text/rooms.hpp"

namespace text {

/// Pins as the data sheet names them, "PK0"; legs in the order a, b, c.
struct FirmwareMap {
  std::string elf;                ///< beside the map, where it is no whole path
  std::vector<std::string> hall;  ///< H1 H2 H3
  std::vector<std::string> upper, lower;
  std::vector<int> currents;  ///< the converter's inputs
  int potentiometer = 3;      ///< and the setpoint's
  double setpoint_range = 1.0;
};

/// `name` is what messages call the file. Problems: all that is wrong with it.
base::Result<FirmwareMap> read_firmware_map(const std::string& name, std::string text);

}  // namespace text

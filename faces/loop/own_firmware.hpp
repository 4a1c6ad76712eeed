// SPDX-License-Identifier: Apache-2.0
// Describes a user's own firmware as a core that runs a scenario.
#pragma once
#include <string>

#include "faces/loop/cores.hpp"
#include "faces/loop/rooms.hpp"
#include "sixstep/base/result.hpp"

namespace loop {

/// Makes a core from a map's path and text (text/firmware_map/). Problems: errors in the map, or a missing
/// program.
base::Result<Core> own_firmware(const std::string& path, const std::string& text);

}  // namespace loop

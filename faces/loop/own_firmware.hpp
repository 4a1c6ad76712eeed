// SPDX-License-Identifier: Apache-2.0
// A firmware that is none of ours, as a core to run a scenario on.
#pragma once
#include <string>

#include "faces/loop/cores.hpp"
#include "faces/loop/rooms.hpp"
#include "sixstep/base/result.hpp"

namespace loop {

/// Of a map's path and text (text/firmware_map/). Problems: what is wrong with it, or a program that is not there.
base::Result<Core> own_firmware(const std::string& path, const std::string& text);

}  // namespace loop

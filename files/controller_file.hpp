// SPDX-License-Identifier: Apache-2.0
// The shared object of a controller of one's own (sixstep/control/own/own_controller.h).
#pragma once
#include <string>

#include "files/rooms.hpp"
#include "text/sources.hpp"

namespace files {

/// Loads it for as long as the program runs; the same file is loaded once. Its bytes count as read (ReadLog). A Problem tells what
/// is missing or wrong in what it says of itself; what it does later is watched (controller_guard.hpp).
base::Result<text::NamedText> load_controller(const std::string& path);

}  // namespace files

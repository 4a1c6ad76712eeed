// SPDX-License-Identifier: Apache-2.0
// Loads the shared object of a user's own controller (sixstep/control/own/own_controller.h).
#pragma once
#include <string>

#include "files/rooms.hpp"
#include "text/sources.hpp"

namespace files {

/// Loads the file until the program ends. A loaded file is not loaded again. A ReadLog also notes the file.
/// Problem: a part of the interface is missing or wrong. Errors during calls are caught by
/// controller_guard.hpp.
base::Result<text::NamedText> load_controller(const std::string& path);

}  // namespace files

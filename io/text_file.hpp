// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <string>

#include "io/rooms.hpp"
#include "sixstep/base/result.hpp"

namespace io {

/// The whole file. Folders, missing and unreadable files are Problems that give the system's reason.
base::Result<std::string> read_text(const std::string& path);

/// The same of a file that another file names: it must be one, for a device or a pipe need not end.
base::Result<std::string> read_regular_text(const std::string& path);

}  // namespace io

// SPDX-License-Identifier: Apache-2.0
// Whose file it is: what sixstep writes says so in its first lines, and nothing else is written over unasked.
#pragma once
#include <string>

#include "io/rooms.hpp"

namespace io {

/// A regular file with something in it that does not begin as one of sixstep's outputs does: "sixstep" and
/// its version in the words of the format. One that cannot be read counts too.
bool is_foreign(const std::string& path);

}  // namespace io

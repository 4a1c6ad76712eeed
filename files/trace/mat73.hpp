// SPDX-License-Identifier: Apache-2.0
// A MAT file of version 7.3: HDF5 with 512 bytes in front and words at each variable that say what it is in MATLAB.
//
// It is written here byte by byte, and not by HDF5's library: all that is small comes first, the columns follow as they are, and
// every byte goes through AtomicFile, which knows when one could not be written. The library writes to and fro and tells its caller
// little of what went wrong; it also dates each object, so that the same run would not make the same file.
#pragma once
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "files/trace/mat_text.hpp"

namespace files {

/// All that stands before the numbers of the columns, which follow one after the other, `rows` each.
std::string mat73_head(const std::vector<std::pair<std::string, MatFields>>& structs,
                       std::span<const std::string> columns, std::size_t rows);

}  // namespace files

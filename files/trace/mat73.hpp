// SPDX-License-Identifier: Apache-2.0
// Writes a MAT file of version 7.3: HDF5 after 512 bytes, and attributes with the MATLAB class of each
// variable.
//
// The file is written byte by byte, without HDF5's library. All small parts come first, the columns follow
// unchanged, and every byte goes through AtomicFile, which detects a failed write. HDF5's library does not
// write sequentially and reports errors poorly. It also dates each object, so that the same run would not
// produce the same file.
#pragma once
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "files/trace/mat_text.hpp"

namespace files {

/// All bytes before the columns' numbers. These follow one column after the other, `rows` numbers each.
std::string mat73_head(const std::vector<std::pair<std::string, MatFields>>& structs,
                       std::span<const std::string> columns, std::size_t rows);

}  // namespace files

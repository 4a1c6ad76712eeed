// SPDX-License-Identifier: Apache-2.0
// Writes a MAT file of version 7.3: 512 bytes, then HDF5 with the MATLAB class of each variable as an
// attribute.
//
// The file is written byte by byte, without HDF5's library. All small parts come first, the columns follow
// unchanged, and every byte is written through AtomicFile, which detects a failed write. HDF5's library does
// not write sequentially and does not report all errors. It also dates each object, so that the same run
// would not give the same file.
#pragma once
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "files/trace/mat_text.hpp"

namespace files {

/// All bytes before the columns' numbers. The numbers follow, one column after the other, `rows` numbers
/// each.
std::string mat73_head(const std::vector<std::pair<std::string, MatFields>>& structs,
                       std::span<const std::string> columns, std::size_t rows);

}  // namespace files

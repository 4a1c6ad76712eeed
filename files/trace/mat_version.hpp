// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstdint>

namespace files {

/// Version of a MAT file: 5 for Octave, scipy and MATLAB; 7.3, which is HDF5, for columns without a size
/// limit.
enum class MatVersion : std::uint8_t { v5, v7_3 };

}  // namespace files

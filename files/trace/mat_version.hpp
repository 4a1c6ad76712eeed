// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstdint>

namespace files {

/// Version of a MAT file. Version 5 is read by Octave, scipy and MATLAB. Version 7.3, which is HDF5, has no
/// size limit for columns.
enum class MatVersion : std::uint8_t { v5, v7_3 };

}  // namespace files

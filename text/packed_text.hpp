// SPDX-License-Identifier: Apache-2.0
// Unpacks texts that tools/embed.py has compressed. Uncompressed pages, motors and tables would enlarge the
// program by 3 %.
#pragma once
#include <cstddef>
#include <string>
#include <string_view>

namespace text {

/// Unpacks a zlib stream of this program to its `size` bytes.
std::string unpacked(std::string_view packed, std::size_t size);

}  // namespace text

// SPDX-License-Identifier: Apache-2.0
// Unpacks texts that tools/embed.py has compressed. Without compression, pages, motors and tables would make
// the program a thirtieth larger.
#pragma once
#include <cstddef>
#include <string>
#include <string_view>

namespace text {

/// Unpacks a zlib stream of this program to its `size` bytes.
std::string unpacked(std::string_view packed, std::size_t size);

}  // namespace text

// SPDX-License-Identifier: Apache-2.0
// Unpacks texts that tools/embed.py has compressed: pages, motors and tables make the program a thirtieth larger otherwise.
#pragma once
#include <cstddef>
#include <string>
#include <string_view>

namespace text {

/// The `size` bytes of a zlib stream that this program contains.
std::string unpacked(std::string_view packed, std::size_t size);

}  // namespace text

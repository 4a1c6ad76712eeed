// SPDX-License-Identifier: Apache-2.0
// Whether a namespace of that name can hold an exported header.
#pragma once
#include <string_view>

namespace text {

/// Names parted by "::", none of them a word that C++ keeps for itself, one that compilers define as a macro, or one that would hide what
/// the header itself names: std and sixstep.
bool is_name_space(std::string_view text);

}  // namespace text

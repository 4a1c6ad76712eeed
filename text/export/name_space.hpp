// SPDX-License-Identifier: Apache-2.0
// Checks the namespace of an exported header.
#pragma once
#include <string_view>

namespace text {

/// Whether the text is a list of names separated by "::". No name may be a C++ keyword, a macro that compilers
/// define, or one that would hide a name which the header uses: std and sixstep.
bool is_name_space(std::string_view text);

}  // namespace text

// SPDX-License-Identifier: Apache-2.0
// Checks the namespace of an exported header.
#pragma once
#include <string_view>

namespace text {

/// Whether the text is a list of names separated by "::". A name may not be a C++ keyword or a macro that
/// compilers define. It may not hide a name that the header uses: std or sixstep.
bool is_name_space(std::string_view text);

}  // namespace text

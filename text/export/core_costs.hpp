// SPDX-License-Identifier: Apache-2.0
// What a header says of the time and the memory that its drive takes on a chip: what the reference drive of its kind was
// counted to take (data/cores/, tools/check_target.sh), core by core and arithmetic by arithmetic.
#pragma once
#include <string>

#include "sixstep/study/compile/compile.hpp"
#include "text/rooms.hpp"

namespace text {

/// Lines of // comment.
std::string core_cost_lines(const study::Compiled& compiled);

}  // namespace text

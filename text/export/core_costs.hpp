// SPDX-License-Identifier: Apache-2.0
// What a header says of the time and the memory that its drive takes on a chip: what the reference drive of its kind was
// counted to take (data/cores/, tools/check_target.sh), core by core and arithmetic by arithmetic.
#pragma once
#include <optional>
#include <string>
#include <string_view>

#include "sixstep/study/compile/compile.hpp"
#include "text/rooms.hpp"

namespace text {

/// Of a control tick at worst, in instructions (of the ATmega2560 in cycles), and of the drive's flash.
struct CoreCost {
  std::string tick, flash_bytes;
};
/// Of a reference drive, "speed", on a core, "Cortex-M4F", in an arithmetic, "float".
std::optional<CoreCost> core_cost(std::string_view core, std::string_view drive, std::string_view arithmetic);

/// Lines of // comment.
std::string core_cost_lines(const study::Compiled& compiled);

}  // namespace text

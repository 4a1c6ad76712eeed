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

/// Least control period of the images (faces/firmware/example/): the STM32F303's is refused below it by its compiler, the ATmega2560's
/// keeps the 100 us of data/scenarios/thesis/avr/ and misses periods below: its tick takes 80 to 104 us. In s.
inline constexpr double stm32_least_period_s = 1600 / 72e6, atmega_least_period_s = 100e-6;

/// In a sentence without a dot, which images a control period is too short for; empty where none.
std::string too_short_for_images(double period_s);

/// Lines of // comment.
std::string core_cost_lines(const study::Compiled& compiled);

}  // namespace text

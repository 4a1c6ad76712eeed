// SPDX-License-Identifier: Apache-2.0
// Writes into a header's comment the time and memory that its drive needs on a chip. The numbers are counts
// of the reference drive of the same kind, per core and arithmetic (data/cores/, tools/check_target.sh).
#pragma once
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "sixstep/study/compile/compile.hpp"
#include "text/rooms.hpp"

namespace text {

/// Worst control tick in instructions (on the ATmega2560 in cycles), and flash of the drive in bytes.
struct CoreCost {
  std::string tick, flash_bytes;
};
/// Cost of a reference drive ("speed") on a core ("Cortex-M4F") in an arithmetic ("float"); empty: not
/// counted.
std::optional<CoreCost> core_cost(std::string_view core, std::string_view drive, std::string_view arithmetic);

/// The keys of a product drive's timing that differ from the values of the STM32F303's image, as in "the
/// STM32F303's image needs pwm.sample = \"start\""; empty if none differs, and for other drives.
std::string other_than_stm32_image(const study::Scenario& scenario);

/// Least control periods in s of the images (faces/firmware/example/).
/// - STM32F303: below stm32_least_period_s, the image does not compile. From stm32_sure_period_s on, none of
/// its commands can be late (docs/howto/compare-a-log.md).
/// - ATmega2560: the image uses the period of 100 us of data/scenarios/thesis/avr/ and misses shorter
/// periods, because its tick takes 80 to 104 us.
inline constexpr double stm32_least_period_s = 1600 / 72e6, stm32_sure_period_s = 5006 / 72e6,
                        atmega_least_period_s = 100e-6;

/// Names the images for which this control period is or may be too short, as a sentence without its full
/// stop; empty if there are none.
std::string too_short_for_images(double period_s);

/// The notes of too_short_for_images() and other_than_stm32_image(), for a header's comment and the terminal.
/// Each note is a sentence without its full stop.
std::vector<std::string> notes_for_images(const study::Scenario& scenario);

/// Lines of // comment.
std::string core_cost_lines(const study::Compiled& compiled);

}  // namespace text

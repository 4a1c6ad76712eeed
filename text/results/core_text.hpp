// SPDX-License-Identifier: Apache-2.0
// What a run on a core is told by: that each answer was the host's, or how long a chip's interrupts took.
#pragma once
#include <string>
#include <vector>

#include "sixstep/study/measure/outcome.hpp"
#include "text/rooms.hpp"

namespace text {

/// "on the Cortex-M4F: 1200 calls, each answered as by the host, to the bit"; of a chip a sentence for each of its interrupts and one where
/// it overran its period, or stands by a fault. Nothing where the host alone ran the drive.
std::vector<std::string> core_texts(const study::Outcome& outcome);

/// Reasons that a chip's serial line told of, "# fault: over-current", in their order, each once.
std::vector<std::string> chip_faults(const study::ChipReport& chip);

/// Cycles as a time: "66.3 us".
std::string cycles_text(double cycles, double clock_Hz);

}  // namespace text

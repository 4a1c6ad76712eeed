// SPDX-License-Identifier: Apache-2.0
// Prints the results of a run on a core: whether each answer equals the host's answer, or the duration of a
// chip's interrupts.
#pragma once
#include <string>
#include <vector>

#include "sixstep/study/measure/outcome.hpp"
#include "text/rooms.hpp"

namespace text {

/// Sentences on the core: "on the Cortex-M4F: 1200 calls, each with the same answer as on the host, in every
/// bit". A chip has a sentence for each interrupt. It has another sentence if an interrupt exceeded its
/// period, or if a fault stopped the chip. Empty if only the host ran the drive.
std::vector<std::string> core_texts(const study::Outcome& outcome);

/// The reasons of lines such as "# fault: over-current" on a chip's serial line, in their order, each once.
std::vector<std::string> chip_faults(const study::ChipReport& chip);

/// A number of cycles as a time: "66.3 us".
std::string cycles_text(double cycles, double clock_Hz);

}  // namespace text

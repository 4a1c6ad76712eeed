// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <string>

#include "sixstep/study/measure/outcome.hpp"

namespace report {

/// The durations of a chip's interrupts if it ran the drive (rig/chip_drive.hpp), each interrupt with a
/// histogram; empty if no chip ran.
std::string chip_section(const sixstep::study::Outcome& outcome);

}  // namespace report

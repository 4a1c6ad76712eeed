// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <string>

#include "sixstep/study/measure/outcome.hpp"

namespace report {

/// The durations of the interrupts if a chip ran the drive (rig/chip_drive.hpp), with a histogram for each
/// interrupt. Empty if no chip ran.
std::string chip_section(const sixstep::study::Outcome& outcome);

}  // namespace report

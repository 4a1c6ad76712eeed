// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <string>

#include "sixstep/study/measure/outcome.hpp"

namespace report {

/// How long the interrupts of a chip took that ran the drive (rig/chip_drive.hpp), each with its histogram; empty where none did.
std::string chip_section(const sixstep::study::Outcome& outcome);

}  // namespace report

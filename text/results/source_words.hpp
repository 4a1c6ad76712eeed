// SPDX-License-Identifier: Apache-2.0
// Describes the supply of the bridge.
#pragma once
#include <string>
#include <string_view>

#include "sixstep/study/scenario/scenario.hpp"
#include "text/rooms.hpp"

namespace text {

/// The supply in words: "24 V", "battery of 5 Ah, 80 % full", "rectified mains of three phases, 400 V at 50
/// Hz"; `given` prints a number and its unit.
std::string source_words(const study::Supply& s, std::string (*given)(double, std::string_view));

}  // namespace text

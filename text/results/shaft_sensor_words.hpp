// SPDX-License-Identifier: Apache-2.0
// What stands on the shaft in the place of Hall probes, in words: all that is said of an encoder, an absolute encoder or a resolver.
#pragma once
#include <cstdint>
#include <string>
#include <string_view>

#include "sixstep/study/scenario/sensors.hpp"
#include "text/rooms.hpp"

namespace text {

/// A page tells the run that it shows, an exported header what its constants were tried with.
enum class SensorWordsOf : std::uint8_t { page, header };

/// "encoder of 1024 lines, ..."; `given` writes a number and its unit. Empty where Hall probes are, or nothing.
std::string shaft_sensor_words(const study::Sensors& s, SensorWordsOf reader,
                               std::string (*given)(double, std::string_view));

}  // namespace text

// SPDX-License-Identifier: Apache-2.0
// Describes the sensor on the shaft in place of Hall probes: an encoder, an absolute encoder or a resolver.
#pragma once
#include <cstdint>
#include <string>
#include <string_view>

#include "sixstep/study/scenario/sensors.hpp"
#include "text/rooms.hpp"

namespace text {

/// Purpose of the words: a page describes the run's sensor, an exported header the sensor with which its
/// constants were tested.
enum class SensorWordsOf : std::uint8_t { page, header };

/// The sensor in words: "encoder of 1024 lines, ..."; `given` prints a number and its unit. Empty with Hall
/// probes or without a sensor.
std::string shaft_sensor_words(const study::Sensors& s, SensorWordsOf reader,
                               std::string (*given)(double, std::string_view));

}  // namespace text

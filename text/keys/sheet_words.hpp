// SPDX-License-Identifier: Apache-2.0
// Translates the words of other sheets and drives for a motor's values into the keys of a motor file.
#pragma once
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "text/rooms.hpp"

namespace text {

/// The cure for a word from a sheet of Faulhaber, Portescap, Nanotec, T-Motor or maxon, or from the settings
/// of VESC, ODrive or SimpleFOC. It names the key of `known` to write, with the frame that such a sheet
/// means. If a motor file has no key for the value, the cure says where the value belongs. Empty if the word
/// is unknown, or if `known` are not the keys of a motor.
std::optional<std::string> by_meaning(std::string_view key, std::span<const std::string> known);

}  // namespace text

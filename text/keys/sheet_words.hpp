// SPDX-License-Identifier: Apache-2.0
// Translates the words of other sheets and drives for a motor's values into the keys of a motor file.
#pragma once
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "text/rooms.hpp"

namespace text {

/// The cure for a word of Faulhaber's, Portescap's, Nanotec's, T-Motor's or maxon's sheets, of VESC, ODrive or
/// SimpleFOC: the key of `known` to write, with the frame that such a sheet means; or the place of the value if
/// a motor file has no key for it. Empty if the word is unknown, or `known` are not the keys of a motor.
std::optional<std::string> by_meaning(std::string_view key, std::span<const std::string> known);

}  // namespace text

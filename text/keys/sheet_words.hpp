// SPDX-License-Identifier: Apache-2.0
// What sheets and drives call the values of a motor, and the keys that mean the same here.
#pragma once
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "text/rooms.hpp"

namespace text {

/// The cure for a word of Faulhaber's, Portescap's, Nanotec's, T-Motor's or maxon's sheets, of VESC, ODrive or SimpleFOC:
/// which of the `known` keys to write, with the frame that such a sheet means, or where the value belongs if the motor's
/// file has no key for it. Empty for a word of no sheet, and where the known keys are not those of a motor.
std::optional<std::string> by_meaning(std::string_view key, std::span<const std::string> known);

}  // namespace text

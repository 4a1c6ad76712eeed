// SPDX-License-Identifier: Apache-2.0
// Clears lines of a sheet that become invalid because other lines are overridden.
#pragma once
#include <functional>
#include <string_view>

#include "sixstep/design/sheet/sheet.hpp"

namespace sixstep::design {

/// Clears lines with the same meaning as an overridden line (torque constants of every form, inductances,
/// pole numbers), because their printed values are then invalid. `overridden` returns whether a key is
/// overridden, in any spelling.
void drop_stale(Sheet& sheet, const std::function<bool(std::string_view key)>& overridden);

}  // namespace sixstep::design

// SPDX-License-Identifier: Apache-2.0
// What of a sheet no longer holds where some of its lines are overridden.
#pragma once
#include <functional>
#include <string_view>

#include "sixstep/design/sheet/sheet.hpp"

namespace sixstep::design {

/// Lines that say the same thing in other words (torque constants of every kind, inductances, pole numbers):
/// with one of them overridden, what the sheet prints in the others is stale and is cleared. `overridden`
/// tells of a key whether it is, in whatever spelling.
void drop_stale(Sheet& sheet, const std::function<bool(std::string_view key)>& overridden);

}  // namespace sixstep::design

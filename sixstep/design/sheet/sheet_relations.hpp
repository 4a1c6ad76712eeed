// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <vector>

#include "sixstep/design/sheet/sheet_check.hpp"

namespace sixstep::design {

/// Every relation whose two sides are in the sheet. known_deviation is not yet considered.
std::vector<Relation> relations_of(const Sheet& sheet, const SheetConstants& constants);

}  // namespace sixstep::design

// SPDX-License-Identifier: Apache-2.0
// Relations of a sheet's no-load points. The speed is compared with n_0 = (U - R I_0)/k_M, the current with
// the friction lines, k_M I_0 = T_c + B w_0.
#pragma once
#include <string>
#include <vector>

#include "sixstep/design/sheet/sheet_term.hpp"

namespace sixstep::design {

/// Two sides of a relation in one unit, before the comparison. `below`, `above`: how far left/right - 1 may
/// be below or above 0, in addition to rounding.
struct NoLoadSides {
  std::string name, left_words, right_words;
  Term left, right;
  std::string unit;
  double below = 0.0, above = 0.0;
  std::string remark;        ///< source of the left side's current, or reason for the tolerance
  bool of_friction = false;  ///< true: a current that is compared with the friction lines
};

/// Relations of the first and the second point: one for each speed and each current that can also be computed
/// from other lines of the sheet.
std::vector<NoLoadSides> no_load_sides(const Sheet& sheet, const SheetConstants& constants);

}  // namespace sixstep::design

// SPDX-License-Identifier: Apache-2.0
// Relations of a sheet's no-load points: the speed with n_0 = (U - R I_0)/k_M, the current with the friction lines,
// k_M I_0 = T_c + B w_0.
#pragma once
#include <string>
#include <vector>

#include "sixstep/design/sheet/sheet_term.hpp"

namespace sixstep::design {

/// Two sides of a relation in one unit, before they are compared. `below`, `above`: how far left/right - 1 may lie
/// below or above 0, beyond rounding.
struct NoLoadSides {
  std::string name, left_words, right_words;
  Term left, right;
  std::string unit;
  double below = 0.0, above = 0.0;
  std::string remark;        ///< source of the left side's current, or reason for the tolerance
  bool of_friction = false;  ///< a current compared with the friction lines
};

/// For the first and the second point: each speed and each current that the sheet also gives in another way.
std::vector<NoLoadSides> no_load_sides(const Sheet& sheet, const SheetConstants& constants);

}  // namespace sixstep::design

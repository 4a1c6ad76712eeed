// SPDX-License-Identifier: Apache-2.0
// What a sheet's no-load points are held against: the speed against n_0 = (U - R I_0)/k_M, the current against the
// friction lines, k_M I_0 = T_c + B w_0.
#pragma once
#include <string>
#include <vector>

#include "sixstep/design/sheet/sheet_term.hpp"

namespace sixstep::design {

/// Two sides of a relation in one unit, not yet judged; `below` and `above` widen what rounding allows.
struct NoLoadSides {
  std::string name, left_words, right_words;
  Term left, right;
  std::string unit;
  double below = 0.0, above = 0.0;
  std::string remark;        ///< where the left side's current is from, or why so much is allowed
  bool of_friction = false;  ///< a current against the friction lines
};

/// Of the first point and the second, each speed and each current that the sheet gives another way to.
std::vector<NoLoadSides> no_load_sides(const Sheet& sheet, const SheetConstants& constants);

}  // namespace sixstep::design

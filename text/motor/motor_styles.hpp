// SPDX-License-Identifier: Apache-2.0
// Lists the styles of motor files to be filled in: which keys each kind of sheet has, in its order.
#pragma once
#include <string_view>
#include <utility>
#include <vector>

#include "text/rooms.hpp"

namespace text {

struct MotorStyle {
  std::string_view name;
  std::string_view what;
  std::string_view shape;                  ///< the usual back-EMF of such a sheet; to be checked
  std::vector<std::string_view> needed;    ///< keys that a model needs
  std::vector<std::string_view> optional;  ///< useful keys: they are checked against the others
  bool linear = false;
  /// The word for a key on such a sheet; or, if the sheet omits it, the usual range, its reason and how to
  /// measure it.
  std::vector<std::pair<std::string_view, std::string_view>> notes = {};
};

const std::vector<MotorStyle>& motor_styles();

}  // namespace text

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
  std::string_view shape;                ///< the usual back-EMF shape of such a sheet; the user must check it
  std::vector<std::string_view> needed;  ///< keys that the model requires
  std::vector<std::string_view> optional;  ///< keys that only serve to check the needed keys
  bool linear = false;
  /// Notes for some keys. A note says which word such a sheet prints. If the sheet omits the value, the note
  /// says why, in which range the value usually lies, and how to measure it.
  std::vector<std::pair<std::string_view, std::string_view>> notes = {};
};

const std::vector<MotorStyle>& motor_styles();

}  // namespace text

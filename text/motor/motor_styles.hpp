// SPDX-License-Identifier: Apache-2.0
// Whose sheet a motor's file is to be filled in from: which keys such a sheet has, in its order.
#pragma once
#include <string_view>
#include <utility>
#include <vector>

#include "text/rooms.hpp"

namespace text {

struct MotorStyle {
  std::string_view name;
  std::string_view what;
  std::string_view shape;                  ///< the back-EMF that such a sheet means, to be looked at
  std::vector<std::string_view> needed;    ///< a model needs them
  std::vector<std::string_view> optional;  ///< worth typing in: they are checked against the others
  bool linear = false;
  /// What a key is called there, or where such a sheet is silent: the usual range, its reason, how to measure it.
  std::vector<std::pair<std::string_view, std::string_view>> notes = {};
};

const std::vector<MotorStyle>& motor_styles();

}  // namespace text

// SPDX-License-Identifier: Apache-2.0
// Six-step commutation for a controller that only computes a signed duty: the pair of the Hall code, reversed for a
// negative duty.
#pragma once
#include "sixstep/control/commutation.hpp"
#include "sixstep/control/own/own_controller.h"

namespace sixstep::control {

/// Sets enabled, source, sink and duty of the answer. `duty`: -1..1, positive for positive torque. A code without a sector (000,
/// 111) turns the bridge off.
constexpr void command_pair(double duty, std::uint8_t code, sixstep_answer& answer) {
  const std::uint8_t sector = sector_of_hall(code);
  const Pair positive = positive_pair(sector);
  const Pair pair = duty < 0.0 ? swapped(positive) : positive;
  answer.enabled = sector != no_sector;
  answer.source = static_cast<std::uint8_t>(pair.source);
  answer.sink = static_cast<std::uint8_t>(pair.sink);
  answer.duty = static_cast<sixstep_real>(duty < 0.0 ? -duty : duty);
}

}  // namespace sixstep::control

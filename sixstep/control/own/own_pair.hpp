// SPDX-License-Identifier: Apache-2.0
// Six-step commutation for a controller that only computes a signed duty. The functions compute the current
// of the Hall code's pair, set the pair (exchanged for a negative duty), and convert answers and commands.
#pragma once
#include "sixstep/control/bridge_command.hpp"
#include "sixstep/control/commutation.hpp"
#include "sixstep/control/own/own_controller.h"

namespace sixstep::control {

/// Sets enabled, source, sink and duty of the answer. `duty`: -1..1, positive for positive torque. A code
/// without a sector (000, 111) turns the bridge off.
constexpr void command_pair(sixstep_real duty, std::uint8_t code, sixstep_answer& answer) {
  const std::uint8_t sector = sector_of_hall(code);
  const Pair positive = positive_pair(sector);
  const Pair pair = duty < 0 ? swapped(positive) : positive;
  answer.enabled = sector != no_sector;
  answer.source = static_cast<std::uint8_t>(pair.source);
  answer.sink = static_cast<std::uint8_t>(pair.sink);
  answer.duty = duty < 0 ? -duty : duty;
}

/// Motor current, A, of the pair with positive torque: half the difference of the source's and the
/// sink's current.
constexpr sixstep_real pair_current(const sixstep_measured& measured) {
  const Pair positive = positive_pair(sector_of_hall(measured.hall));
  return (measured.current_A[static_cast<unsigned>(positive.source)] -
          measured.current_A[static_cast<unsigned>(positive.sink)]) /
         2;
}

/// Converts a command to the answer of a controller that outputs pairs. The answer's other members do not
/// change.
constexpr void answer_pair(const BridgeCommand<sixstep_real>& command, sixstep_answer& answer) {
  answer.enabled = command.enabled;
  answer.fault = command.fault;
  answer.source = static_cast<std::uint8_t>(command.pair.source);
  answer.sink = static_cast<std::uint8_t>(command.pair.sink);
  answer.chopping = static_cast<std::uint8_t>(command.chopping);
  answer.chopped = static_cast<std::uint8_t>(command.chopped);
  answer.duty = command.duty;
  answer.overlap = command.overlap;
}

/// Converts a valid answer with a pair to the command of gates.hpp.
constexpr BridgeCommand<sixstep_real> pair_command(const sixstep_answer& answer) {
  BridgeCommand<sixstep_real> command{};
  command.enabled = answer.enabled != 0;
  command.pair = {static_cast<Leg>(answer.source), static_cast<Leg>(answer.sink)};
  command.duty = answer.duty;
  command.overlap = answer.overlap;
  command.chopping = static_cast<Chopping>(answer.chopping);
  command.chopped = static_cast<ChoppedSwitch>(answer.chopped);
  return command;
}

}  // namespace sixstep::control

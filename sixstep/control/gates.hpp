// SPDX-License-Identifier: Apache-2.0
// Converts a bridge command to the six gates of one instant, for firmware that sets pins or the output modes
// of a timer. In the on-time of a PWM period both driven switches are on. In the off-time (model.md 3) these
// switches are on:
//   soft           the driven switch that is not chopped: the sink's lower or the source's upper switch
//   hard           no switch
//   complementary  as soft, and also the second switch of the chopped leg, after the dead time that the timer
//                  inserts
#pragma once
#include <cstdint>

#include "sixstep/control/bridge_command.hpp"
#include "sixstep/control/leg_command.hpp"

namespace sixstep::control {

/// Bit of a switch: 0, 2, 4 for the upper switches of a, b, c (T1 T3 T5); 1, 3, 5 for the lower switches (T2
/// T4 T6).
constexpr std::uint8_t upper_gate(Leg leg) {
  return static_cast<std::uint8_t>(1u << (2u * static_cast<unsigned>(leg)));
}
constexpr std::uint8_t lower_gate(Leg leg) {
  return static_cast<std::uint8_t>(2u << (2u * static_cast<unsigned>(leg)));
}

/// Gates of a six-step command. Both switches of a leg are never on: if source and sink are the same leg, no
/// switch is on.
template <class Scalar>
constexpr std::uint8_t gates(const BridgeCommand<Scalar>& command, bool on_time) {
  if (!command.enabled || command.pair.source == command.pair.sink) return 0;
  const Leg source = command.pair.source, sink = command.pair.sink;
  if (on_time) return static_cast<std::uint8_t>(upper_gate(source) | lower_gate(sink));
  if (command.chopping == Chopping::hard) return 0;
  const bool lower = command.chopped == ChoppedSwitch::lower;
  const std::uint8_t on = lower ? upper_gate(source) : lower_gate(sink);
  if (command.chopping == Chopping::soft) return on;
  return static_cast<std::uint8_t>((lower ? upper_gate(sink) : lower_gate(source)) | on);
}

/// Gates of one leg, in its pulse or in the rest of the period.
template <class Scalar>
constexpr std::uint8_t gates(const LegCommand<Scalar>& command, Leg leg, bool pulse) {
  const LegSides sides = sides_of(command);
  const LegSide side = pulse ? sides.pulse : sides.rest;
  return side == LegSide::high ? upper_gate(leg) : side == LegSide::low ? lower_gate(leg) : std::uint8_t{0};
}

}  // namespace sixstep::control

// SPDX-License-Identifier: Apache-2.0
// Defines the commands of the bridge's legs, one per leg, for a timer's channels (model.md 11). A controller
// outputs either three leg commands, or for six-step a pair and one duty (bridge_command.hpp). BridgeCommand
// does not contain leg commands, so that a six-step chip stores and copies no more than it needs. as_legs()
// converts a pair to three commands.
#pragma once
#include <cstdint>

#include "sixstep/control/bridge_command.hpp"

namespace sixstep::control {

/// State of a leg during a PWM period.
enum class LegState : std::uint8_t { off, low, high, pwm };

/// Switches of a pwm leg that are on in the pulse, which lasts `duty` of the period, and in the rest of the
/// period.
enum class PwmSwitches : std::uint8_t {
  complementary,  ///< pulse: the upper switch; rest: the lower switch; each after the dead time
  upper,          ///< pulse: the upper switch; rest: none
  lower,          ///< pulse: the lower switch; rest: none, like a timer channel of which only the
                  ///< complementary output is enabled
  lower_first     ///< pulse: the lower switch; rest: the upper switch; each after the dead time
};

template <class Scalar>
struct LegCommand {
  LegState state = LegState::off;
  PwmSwitches switches = PwmSwitches::complementary;
  Scalar duty{};  ///< 0..1, pulse length divided by PWM period; used only in state pwm
  bool operator==(const LegCommand&) const = default;
};

template <class Scalar>
struct LegCommands {
  bool enabled = false;         ///< false: all six gates off
  bool fault = false;           ///< true: the controller has stopped the drive; the bridge is off
  LegCommand<Scalar> leg[3]{};  ///< commands of legs a, b, c
  bool operator==(const LegCommands&) const = default;
};

/// The switch of a leg that must be on.
enum class LegSide : std::uint8_t { none, low, high };

/// Switch that is on in the pulse, and switch that is on in the rest of the period.
struct LegSides {
  LegSide pulse = LegSide::none, rest = LegSide::none;
};

template <class Scalar>
constexpr LegSides sides_of(const LegCommand<Scalar>& command) {
  switch (command.state) {
    case LegState::low:
      return {LegSide::low, LegSide::low};
    case LegState::high:
      return {LegSide::high, LegSide::high};
    case LegState::pwm:
      if (command.switches == PwmSwitches::lower) return {LegSide::low, LegSide::none};
      if (command.switches == PwmSwitches::lower_first) return {LegSide::low, LegSide::high};
      return {LegSide::high, command.switches == PwmSwitches::complementary ? LegSide::low : LegSide::none};
    case LegState::off:
      break;
  }
  return {};
}

/// Command of the leg through which the driven pair's current enters the motor (model.md 3): its upper switch
/// is chopped, or on throughout.
template <class Scalar>
constexpr LegCommand<Scalar> source_leg(Chopping chopping, ChoppedSwitch chopped, Scalar duty) {
  if (chopping != Chopping::hard && chopped == ChoppedSwitch::lower)
    return {LegState::high, PwmSwitches::complementary, Scalar{}};
  return {LegState::pwm,
          chopping == Chopping::complementary ? PwmSwitches::complementary : PwmSwitches::upper, duty};
}

/// Command of the leg through which the current leaves the motor: its lower switch is chopped, or on
/// throughout.
template <class Scalar>
constexpr LegCommand<Scalar> sink_leg(Chopping chopping, ChoppedSwitch chopped, Scalar duty) {
  if (chopping == Chopping::hard) return {LegState::pwm, PwmSwitches::lower, duty};
  if (chopped == ChoppedSwitch::lower)
    return {LegState::pwm,
            chopping == Chopping::complementary ? PwmSwitches::lower_first : PwmSwitches::lower, duty};
  return {LegState::low, PwmSwitches::complementary, Scalar{}};
}

/// Command of the leg that has left the pair, while one of its switches still feeds the decaying current.
template <class Scalar>
constexpr LegCommand<Scalar> overlapping_leg(Scalar overlap) {
  const bool upper = Scalar{} < overlap;
  return {LegState::pwm, upper ? PwmSwitches::upper : PwmSwitches::lower, upper ? overlap : -overlap};
}

/// A six-step command as three leg commands. With armed comparators the command has no duty, and all legs are
/// off.
template <class Scalar>
constexpr LegCommands<Scalar> as_legs(const BridgeCommand<Scalar>& command) {
  LegCommands<Scalar> legs{};
  legs.fault = command.fault;
  if (!command.enabled || command.watch != Watch::none || command.pair.source == command.pair.sink)
    return legs;
  legs.enabled = true;
  legs.leg[static_cast<unsigned>(command.pair.source)] =
      source_leg(command.chopping, command.chopped, command.duty);
  legs.leg[static_cast<unsigned>(command.pair.sink)] =
      sink_leg(command.chopping, command.chopped, command.duty);
  if (command.overlap != Scalar{})
    legs.leg[static_cast<unsigned>(free_leg(command.pair))] = overlapping_leg(command.overlap);
  return legs;
}

}  // namespace sixstep::control

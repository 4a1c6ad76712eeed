// SPDX-License-Identifier: Apache-2.0
// The second answer of a controller: one command per leg, as a timer's channel takes it (model.md 11).
// Six-step answers with a pair and one duty (bridge_command.hpp); that struct knows nothing of this one, so
// that a six-step chip carries and copies no more than it needs. How six-step reads as three legs is stated
// here.
#pragma once
#include <cstdint>

#include "sixstep/control/bridge_command.hpp"

namespace sixstep::control {

/// What a leg does for a PWM period.
enum class LegState : std::uint8_t { off, low, high, pwm };

/// What the pulse of a pwm leg, `duty` of the period long, turns on.
enum class PwmSwitches : std::uint8_t {
  complementary,  ///< the upper switch; the lower one for the rest of the period, each after the dead time
  upper,          ///< the upper switch alone: none for the rest
  lower,          ///< the lower switch alone, as a channel does whose complementary output alone is enabled
  lower_first     ///< the lower switch; the upper one for the rest of the period, each after the dead time
};

template <class Scalar>
struct LegCommand {
  LegState state = LegState::off;
  PwmSwitches switches = PwmSwitches::complementary;
  Scalar duty{};  ///< 0..1, length of the pulse over the PWM period; ignored but for pwm
  bool operator==(const LegCommand&) const = default;
};

template <class Scalar>
struct LegCommands {
  bool enabled = false;         ///< false: all six gates off
  bool fault = false;           ///< the controller gave up; the bridge is off
  LegCommand<Scalar> leg[3]{};  ///< of a, b, c
  bool operator==(const LegCommands&) const = default;
};

/// The switch of a leg that is to be on.
enum class LegSide : std::uint8_t { none, low, high };

/// Within the pulse and in the rest of the period.
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

/// The leg that the current of a driven pair enters by (model.md 3): its upper switch chops, or is on throughout.
template <class Scalar>
constexpr LegCommand<Scalar> source_leg(Chopping chopping, ChoppedSwitch chopped, Scalar duty) {
  if (chopping != Chopping::hard && chopped == ChoppedSwitch::lower)
    return {LegState::high, PwmSwitches::complementary, Scalar{}};
  return {LegState::pwm,
          chopping == Chopping::complementary ? PwmSwitches::complementary : PwmSwitches::upper, duty};
}

/// The leg that it leaves by: its lower switch is on throughout, or chops too.
template <class Scalar>
constexpr LegCommand<Scalar> sink_leg(Chopping chopping, ChoppedSwitch chopped, Scalar duty) {
  if (chopping == Chopping::hard) return {LegState::pwm, PwmSwitches::lower, duty};
  if (chopped == ChoppedSwitch::lower)
    return {LegState::pwm,
            chopping == Chopping::complementary ? PwmSwitches::lower_first : PwmSwitches::lower, duty};
  return {LegState::low, PwmSwitches::complementary, Scalar{}};
}

/// The leg that is in no pair, while it keeps up a part of the current that leaves it.
template <class Scalar>
constexpr LegCommand<Scalar> overlapping_leg(Scalar overlap) {
  const bool upper = Scalar{} < overlap;
  return {LegState::pwm, upper ? PwmSwitches::upper : PwmSwitches::lower, upper ? overlap : -overlap};
}

/// Six-step as three leg commands: a duty's, for comparators have none.
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

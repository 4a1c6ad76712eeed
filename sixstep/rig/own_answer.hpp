// SPDX-License-Identifier: Apache-2.0
// Converts the answer of a user's controller to a command for the timer, or finds why no timer can execute it.
#pragma once
#include <cstdint>

#include "sixstep/control/leg_command.hpp"
#include "sixstep/control/own/own_controller.h"

namespace sixstep::rig {

/// Reason why an answer was not executed.
enum class OwnWrong : std::uint8_t {
  none,
  gave_up,  ///< the controller itself reports a fault
  duty,     ///< not a number from 0 to 1
  leg,      ///< an invalid leg, or source and sink are the same leg
  choice,   ///< an invalid chopping, switch or state
};

// The C interface has the same names in the same order.
static_assert(SIXSTEP_LEG_C == static_cast<int>(control::Leg::c) &&
              SIXSTEP_SOFT == static_cast<int>(control::Chopping::soft) &&
              SIXSTEP_HARD == static_cast<int>(control::Chopping::hard) &&
              SIXSTEP_COMPLEMENTARY == static_cast<int>(control::Chopping::complementary) &&
              SIXSTEP_LOWER == static_cast<int>(control::ChoppedSwitch::lower));
static_assert(SIXSTEP_LEG_OFF == static_cast<int>(control::LegState::off) &&
              SIXSTEP_LEG_LOW == static_cast<int>(control::LegState::low) &&
              SIXSTEP_LEG_HIGH == static_cast<int>(control::LegState::high) &&
              SIXSTEP_LEG_PWM == static_cast<int>(control::LegState::pwm) &&
              SIXSTEP_PWM_COMPLEMENTARY == static_cast<int>(control::PwmSwitches::complementary) &&
              SIXSTEP_PWM_UPPER == static_cast<int>(control::PwmSwitches::upper) &&
              SIXSTEP_PWM_LOWER == static_cast<int>(control::PwmSwitches::lower) &&
              SIXSTEP_PWM_LOWER_FIRST == static_cast<int>(control::PwmSwitches::lower_first));

namespace detail {

constexpr bool is_part(double x) { return x >= 0.0 && x <= 1.0; }

}  // namespace detail

template <class Command>
constexpr OwnWrong wrong_in(const sixstep_answer& a) {
  if (a.fault != 0) return OwnWrong::gave_up;
  if (a.enabled == 0) return OwnWrong::none;
  if constexpr (requires(Command command) { command.pair; }) {
    if (a.source > SIXSTEP_LEG_C || a.sink > SIXSTEP_LEG_C || a.source == a.sink) return OwnWrong::leg;
    if (a.chopping > SIXSTEP_COMPLEMENTARY || a.chopped > SIXSTEP_LOWER) return OwnWrong::choice;
    const bool parts = detail::is_part(a.duty) && detail::is_part(a.overlap < 0.0 ? -a.overlap : a.overlap);
    return parts ? OwnWrong::none : OwnWrong::duty;
  } else {
    for (const sixstep_leg& leg : a.leg) {
      if (leg.state > SIXSTEP_LEG_PWM || leg.switches > SIXSTEP_PWM_LOWER_FIRST) return OwnWrong::choice;
      if (leg.state == SIXSTEP_LEG_PWM && !detail::is_part(leg.duty)) return OwnWrong::duty;
    }
    return OwnWrong::none;
  }
}

/// Command of a valid answer.
template <class Command>
constexpr Command command_of(const sixstep_answer& a) {
  Command command{};
  command.enabled = a.enabled != 0;
  if constexpr (requires { command.pair; }) {
    command.pair = {static_cast<control::Leg>(a.source), static_cast<control::Leg>(a.sink)};
    command.duty = a.duty;
    command.overlap = a.overlap;
    command.chopping = static_cast<control::Chopping>(a.chopping);
    command.chopped = static_cast<control::ChoppedSwitch>(a.chopped);
  } else {
    for (unsigned k = 0; k < 3; ++k)
      command.leg[k] = {static_cast<control::LegState>(a.leg[k].state),
                        static_cast<control::PwmSwitches>(a.leg[k].switches), a.leg[k].duty};
  }
  return command;
}

}  // namespace sixstep::rig

// SPDX-License-Identifier: Apache-2.0
// Converts the answer of a user's controller to a command for the timer, or determines why the timer cannot
// execute the answer.
#pragma once
#include <cstdint>

#include "sixstep/control/leg_command.hpp"
#include "sixstep/control/own/own_controller.h"
#include "sixstep/control/own/own_pair.hpp"

namespace sixstep::rig {

/// Reason why an answer was not executed.
enum class OwnWrong : std::uint8_t {
  none,
  gave_up,  ///< the controller reports a fault
  duty,     ///< a duty outside 0 to 1, or an overlap outside -1 to 1
  leg,      ///< an invalid leg, or source and sink are the same leg
  choice,   ///< an invalid chopping, switch or state
};

/// The first invalid field of an answer, and the call that returned the answer.
struct OwnFinding {
  OwnWrong what = OwnWrong::none;
  const char* field = "";  ///< name of the field, such as "duty" or "leg[1].state"
  double value = 0.0;
  std::int64_t steps = 0;       ///< calls of step() so far
  bool in_hall = false;         ///< true: hall() returned the answer; false: step() returned it
  const char* controller = "";  ///< file of the controller; valid as long as the firmware exists
};

// The constants of the C interface have the same values as the C++ enumerators.
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
constexpr OwnFinding wrong_in(const sixstep_answer& a) {
  using enum OwnWrong;
  if (a.fault != 0) return {gave_up, "fault", static_cast<double>(a.fault)};
  if (a.enabled == 0) return {};
  if constexpr (requires(Command command) { command.pair; }) {
    if (a.source > SIXSTEP_LEG_C) return {leg, "source", static_cast<double>(a.source)};
    if (a.sink > SIXSTEP_LEG_C || a.source == a.sink) return {leg, "sink", static_cast<double>(a.sink)};
    if (a.chopping > SIXSTEP_COMPLEMENTARY) return {choice, "chopping", static_cast<double>(a.chopping)};
    if (a.chopped > SIXSTEP_LOWER) return {choice, "chopped", static_cast<double>(a.chopped)};
    if (!detail::is_part(a.duty)) return {duty, "duty", a.duty};
    if (!detail::is_part(a.overlap < 0.0 ? -a.overlap : a.overlap)) return {duty, "overlap", a.overlap};
  } else {
    constexpr const char* names[3][3] = {{"leg[0].state", "leg[0].switches", "leg[0].duty"},
                                         {"leg[1].state", "leg[1].switches", "leg[1].duty"},
                                         {"leg[2].state", "leg[2].switches", "leg[2].duty"}};
    for (unsigned k = 0; k < 3; ++k) {
      const sixstep_leg& is = a.leg[k];
      if (is.state > SIXSTEP_LEG_PWM) return {choice, names[k][0], static_cast<double>(is.state)};
      if (is.switches > SIXSTEP_PWM_LOWER_FIRST)
        return {choice, names[k][1], static_cast<double>(is.switches)};
      if (is.state == SIXSTEP_LEG_PWM && !detail::is_part(is.duty)) return {duty, names[k][2], is.duty};
    }
  }
  return {};
}

/// Command for the timer. `a` must be valid according to wrong_in().
template <class Command>
constexpr Command command_of(const sixstep_answer& a) {
  if constexpr (requires(Command command) { command.pair; }) {
    return control::pair_command(a);
  } else {
    Command command{};
    command.enabled = a.enabled != 0;
    for (unsigned k = 0; k < 3; ++k)
      command.leg[k] = {static_cast<control::LegState>(a.leg[k].state),
                        static_cast<control::PwmSwitches>(a.leg[k].switches), a.leg[k].duty};
    return command;
  }
}

}  // namespace sixstep::rig

// SPDX-License-Identifier: Apache-2.0
// Selects the operating state of a drive: off, calibrate, align, run, brake, fault. This file contains only
// the transitions; protected_drive.hpp performs the actions of each state.
//
//   off --start--> calibrate --offsets measured--> align --rotor in place--> run
//   run --stop--> brake --at rest--> off;  brake --start--> run;  calibrate, align --stop--> off
//   any --fault--> fault --clear, no cause present--> off
//
// Offsets are measured once, and again after a fault. The alignment is optional.
#pragma once
#include <cstdint>

namespace sixstep::control {

enum class Activity : std::uint8_t { off, calibrate, align, run, brake, fault };

/// Requests of the user. `run` acts as a level. `clear` acts only when it changes from false to true, so that
/// a button that stays pressed does not restart a faulty drive repeatedly.
struct Request {
  bool run = false;
  bool clear = false;
};

struct ActivityInput {
  Request request{};
  bool calibrated = false;  ///< true: the offsets are measured
  bool aligned = false;     ///< true: the rotor has reached its alignment, or there is no alignment
  bool standing = false;    ///< true: the rotor is slow enough to end the braking
  bool faulty = false;      ///< true: a fault is latched
};

struct ActivityState {
  Activity activity = Activity::off;
  bool clear_was = false;
  bool run_released = true;  ///< true: since the last fault `run` was false; only then may `run` start the
                             ///< drive
};

/// True if faults must be cleared now. Call it before activity_step, and pass activity_step the remaining
/// faults.
constexpr bool clear_requested(ActivityState& state, const Request& request) {
  const bool rising = request.clear && !state.clear_was;
  state.clear_was = request.clear;
  return rising && state.activity == Activity::fault;
}

constexpr Activity after(Activity activity, bool run, const ActivityInput& in) {
  switch (activity) {
    case Activity::off:
    case Activity::calibrate:
      return !run ? Activity::off : in.calibrated ? Activity::align : Activity::calibrate;
    case Activity::align:
      return !run ? Activity::off : in.aligned ? Activity::run : Activity::align;
    case Activity::run:
      return run ? Activity::run : Activity::brake;
    case Activity::brake:
      return run ? Activity::run : in.standing ? Activity::off : Activity::brake;
    case Activity::fault:
      return Activity::off;  // this state is left only if no fault is latched
  }
  return Activity::off;
}

constexpr Activity activity_step(ActivityState& state, const ActivityInput& in) {
  if (in.faulty) {
    state.activity = Activity::fault;
    state.run_released = false;
    return state.activity;
  }
  if (!in.request.run) state.run_released = true;
  state.activity = after(state.activity, in.request.run && state.run_released, in);
  return state.activity;
}

}  // namespace sixstep::control

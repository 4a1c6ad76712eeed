// SPDX-License-Identifier: Apache-2.0
// Reasons why a run of the virtual board ends early.
#pragma once
#include <cstdint>

#include "sixstep/rig/firmware.hpp"

namespace sixstep::rig {

enum class Fault : std::uint8_t {
  none,
  shoot_through,
  impossible_hall,
  beyond_model,
  shaft_sensor,
  own_controller,
  north_unseen,
  not_started,
  core
};

/// Kind of the fault that a firmware has detected.
inline Fault fault_of(const Diagnosis& found) {
  if (found.core != CoreTrouble::none) return Fault::core;
  if (found.shaft.lost()) return Fault::shaft_sensor;
  if (found.unseen > 0) return Fault::north_unseen;
  if (found.gave_up) return Fault::not_started;
  return found.own.what != OwnWrong::none ? Fault::own_controller : Fault::impossible_hall;
}

/// True if a fault that the firmware has detected ends the run. Otherwise the drive turns off and the motor
/// coasts.
template <class Firmware>
bool ends_run([[maybe_unused]] const Firmware& firmware) {
  if constexpr (requires { firmware.ends_run_by_fault(); })
    return firmware.ends_run_by_fault();
  else if constexpr (requires { firmware.core_lost(); })
    return firmware.core_lost();
  else
    return Firmware::fault_ends_run;
}

}  // namespace sixstep::rig

// SPDX-License-Identifier: Apache-2.0
// Messages between the plant and a core that executes the drive without a rotor position sensor
// (control/commissioning/pulse_start.hpp). Their form is that of core_call.hpp, with additional entries for
// the drive's timer and comparators.
#pragma once
#include "sixstep/control/commissioning/pulse_start.hpp"
#include "sixstep/rig/core_call.hpp"

namespace sixstep::rig {

template <class Scalar>
struct SensorlessCall {
  CoreEntry entry = CoreEntry::tick;
  std::uint32_t now = 0;   ///< count of the timer
  std::uint32_t pins = 0;  ///< pins of Hall probes; with entry `capture`: lines of the comparators
  std::uint32_t on = 0, on_ticks = 0;
  std::uint32_t terminal_counts[3]{}, bus_counts = 0, current_counts[3]{};
  control::Measurement<Scalar> measured{};
  control::Setpoint<Scalar> setpoint{};
};

template <class Scalar>
constexpr SensorlessCall<Scalar> call_of(const control::PulsedDriveInput<Scalar>& input,
                                         const control::Setpoint<Scalar>& setpoint) {
  const control::SensorlessDriveInput<Scalar>& in = input.drive;
  SensorlessCall<Scalar> call{.now = in.terminals.at,
                              .pins = in.hall_pins,
                              .on = in.on,
                              .on_ticks = in.on_ticks,
                              .bus_counts = in.terminals.bus,
                              .measured = in.measured,
                              .setpoint = setpoint};
  for (int k = 0; k < 3; ++k) {
    call.terminal_counts[k] = in.terminals.u[k];
    call.current_counts[k] = input.current_counts[k];
  }
  return call;
}
/// Converts a call back to the input, on the core.
template <class Scalar>
constexpr control::PulsedDriveInput<Scalar> input_of(const SensorlessCall<Scalar>& call) {
  const auto counts = [](std::uint32_t n) { return static_cast<std::uint16_t>(n); };
  control::PulsedDriveInput<Scalar> input;
  control::SensorlessDriveInput<Scalar>& in = input.drive;
  in.measured = call.measured;
  in.terminals.at = call.now;
  in.terminals.bus = counts(call.bus_counts);
  in.hall_pins = static_cast<std::uint8_t>(call.pins);
  in.on = call.on != 0;
  in.on_ticks = call.on_ticks;
  for (int k = 0; k < 3; ++k) {
    in.terminals.u[k] = counts(call.terminal_counts[k]);
    input.current_counts[k] = counts(call.current_counts[k]);
  }
  return input;
}

/// Command for the bridge, and the timer count `next` of the next commutation, valid if `commutes` is not 0.
template <class Scalar>
struct SensorlessCoreAnswer {
  std::uint32_t commutes = 0, next = 0;
  CoreAnswer<Scalar> bridge{};
  bool operator==(const SensorlessCoreAnswer&) const = default;
};

template <class Scalar>
constexpr SensorlessCoreAnswer<Scalar> answer_of(const control::PulsedDriveState<Scalar>& state) {
  SensorlessCoreAnswer<Scalar> out;
  out.commutes = control::next_commutation(state.drive, out.next);
  out.bridge = answer_of(state.drive.drive.command);
  return out;
}

}  // namespace sixstep::rig

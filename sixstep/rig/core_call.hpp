// SPDX-License-Identifier: Apache-2.0
// Messages between the plant and a core that executes the drive (lockstep_core.hpp): arguments of the drive's
// functions, and the core's answers. They are plain structs of words and scalars. Their layout is the same
// with all compilers for 32-bit cores and on a host with the same byte order. The core's program
// (faces/loop/core/) includes this file too.
#pragma once
#include <cstdint>

#include "sixstep/control/bridge_command.hpp"
#include "sixstep/control/field/field_direction.hpp"
#include "sixstep/control/leg_command.hpp"
#include "sixstep/control/protected_drive.hpp"

namespace sixstep::rig {

/// Entries of a drive: its functions that a board calls.
enum class CoreEntry : std::uint32_t {
  tick,
  hall,
  start,      ///< product drive, called once: `now` is the rotor's sector at the start
  commutate,  ///< sensorless drive: compare match of the timer
  capture     ///< sensorless drive: an edge of the comparators at the terminals
};

/// Calls of control/drive.hpp: step() and on_hall().
template <class Scalar>
struct LeanCall {
  CoreEntry entry = CoreEntry::tick;
  std::uint32_t pins = 0;  ///< hall: H1 H2 H3 as bits 2, 1, 0
  control::Measurement<Scalar> measured{};
  control::Setpoint<Scalar> setpoint{};
};

/// Calls of control/protected_drive.hpp: protected_step(), and protected_on_hall() with the input's pins and
/// counter.
template <class Scalar>
struct ProductCall {
  CoreEntry entry = CoreEntry::tick;
  std::uint32_t run = 0, clear = 0;  ///< members of control::Request
  std::uint32_t now = 0;             ///< these members and the next: control::BoardInput, as words
  std::uint32_t current_counts[3]{}, bus_counts = 0, hall_pins = 0;
  control::Setpoint<Scalar> setpoint{};
};

/// Call of control/field/field_drive.hpp: field_drive_step(). If the angle is decoded, the core computes the
/// directions from the angle.
template <class Scalar>
struct FieldCall {
  CoreEntry entry = CoreEntry::tick;
  std::uint32_t decoded = 0;            ///< 0: `magnet` is the output of an ideal sensor
  control::BinaryAngle electrical = 0;  ///< angle of the rotor, if decoded
  std::uint32_t unused = 0;
  control::Measurement<Scalar> measured{};
  control::Setpoint<Scalar> setpoint{};
  control::FieldDirections<Scalar> magnet{};
};

template <class Scalar>
constexpr ProductCall<Scalar> call_of(const control::BoardInput& in, const control::Request& request,
                                      const control::Setpoint<Scalar>& setpoint) {
  const auto& counts = in.current_counts;
  return {.run = request.run,
          .clear = request.clear,
          .now = in.now,
          .current_counts = {counts[0], counts[1], counts[2]},
          .bus_counts = in.bus_counts,
          .hall_pins = in.hall_pins,
          .setpoint = setpoint};
}
/// Converts a call back to the input, on the core.
template <class Scalar>
constexpr control::BoardInput input_of(const ProductCall<Scalar>& call) {
  control::BoardInput in{.bus_counts = static_cast<std::uint16_t>(call.bus_counts),
                         .hall_pins = static_cast<std::uint8_t>(call.hall_pins),
                         .now = call.now};
  for (int k = 0; k < 3; ++k) in.current_counts[k] = static_cast<std::uint16_t>(call.current_counts[k]);
  return in;
}

/// A control::BridgeCommand with its enumerators as numbers, so that a wrong answer of a faulty program is
/// never an invalid enumerator.
template <class Scalar>
struct CoreAnswer {
  std::uint8_t enabled = 0, fault = 0, source = 0, sink = 0, chopping = 0, chopped = 0, watch = 0, unused = 0;
  Scalar duty{}, overlap{}, on_below_A{}, off_above_A{};
  bool operator==(const CoreAnswer&) const = default;
};

template <class Scalar>
constexpr CoreAnswer<Scalar> answer_of(const control::BridgeCommand<Scalar>& c) {
  const auto byte = [](auto choice) { return static_cast<std::uint8_t>(choice); };
  return {.enabled = byte(c.enabled),
          .fault = byte(c.fault),
          .source = byte(c.pair.source),
          .sink = byte(c.pair.sink),
          .chopping = byte(c.chopping),
          .chopped = byte(c.chopped),
          .watch = byte(c.watch),
          .duty = c.duty,
          .overlap = c.overlap,
          .on_below_A = c.on_below_A,
          .off_above_A = c.off_above_A};
}

/// A control::LegCommands with its enumerators as numbers.
template <class Scalar>
struct CoreLegs {
  std::uint8_t enabled = 0, fault = 0, state[3]{}, switches[3]{};
  Scalar duty[3]{};
  bool operator==(const CoreLegs&) const = default;
};

template <class Scalar>
constexpr CoreLegs<Scalar> answer_of(const control::LegCommands<Scalar>& c) {
  CoreLegs<Scalar> out{.enabled = c.enabled, .fault = c.fault};
  for (int k = 0; k < 3; ++k) {
    out.state[k] = static_cast<std::uint8_t>(c.leg[k].state);
    out.switches[k] = static_cast<std::uint8_t>(c.leg[k].switches);
    out.duty[k] = c.leg[k].duty;
  }
  return out;
}

/// First message of a core. The plant's side uses it to check that both sides use the same structs.
struct CoreGreeting {
  std::uint32_t word = 0x73697873;  ///< "sixs"
  std::uint32_t call_bytes = 0, answer_bytes = 0;
};

}  // namespace sixstep::rig

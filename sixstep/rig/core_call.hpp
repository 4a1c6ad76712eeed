// SPDX-License-Identifier: Apache-2.0
// What goes between the plant and a core that runs the drive (lockstep_core.hpp): with what an entry of it is called, and what it
// answers. Plain structs of words and scalars, laid out alike by all compilers of cores with 32 bits and by a host with the same
// order of bytes; the core's program (faces/loop/core/) includes this file too.
#pragma once
#include <cstdint>

#include "sixstep/control/bridge_command.hpp"
#include "sixstep/control/field/field_direction.hpp"
#include "sixstep/control/leg_command.hpp"
#include "sixstep/control/protected_drive.hpp"

namespace sixstep::rig {

/// The entries of a drive, and what it knows from the start.
enum class CoreEntry : std::uint32_t {
  tick,
  hall,
  start,      ///< of the product drive, once: `now` is the sector in which the rotor stands
  commutate,  ///< of the sensorless drive: its timer's compare match
  capture     ///< and an edge of the comparators at the terminals
};

/// Of control/drive.hpp: step() and on_hall().
template <class Scalar>
struct LeanCall {
  CoreEntry entry = CoreEntry::tick;
  std::uint32_t pins = 0;  ///< hall: H1 H2 H3 as bits 2, 1, 0
  control::Measurement<Scalar> measured{};
  control::Setpoint<Scalar> setpoint{};
};

/// Of control/protected_drive.hpp: protected_step() and protected_on_hall(), which is given pins and counter of the input.
template <class Scalar>
struct ProductCall {
  CoreEntry entry = CoreEntry::tick;
  std::uint32_t run = 0, clear = 0;  ///< control::Request
  std::uint32_t now = 0;             ///< control::BoardInput, as words
  std::uint32_t current_counts[3]{}, bus_counts = 0, hall_pins = 0;
  control::Setpoint<Scalar> setpoint{};
};

/// Of control/field/field_drive.hpp: field_drive_step(). Of an angle that was decoded the core makes the directions itself.
template <class Scalar>
struct FieldCall {
  CoreEntry entry = CoreEntry::tick;
  std::uint32_t decoded = 0;            ///< else `magnet` is what an ideal sensor tells
  control::BinaryAngle electrical = 0;  ///< of the rotor, where it was decoded
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
/// And back, on the core.
template <class Scalar>
constexpr control::BoardInput input_of(const ProductCall<Scalar>& call) {
  control::BoardInput in{.bus_counts = static_cast<std::uint16_t>(call.bus_counts),
                         .hall_pins = static_cast<std::uint8_t>(call.hall_pins),
                         .now = call.now};
  for (int k = 0; k < 3; ++k) in.current_counts[k] = static_cast<std::uint16_t>(call.current_counts[k]);
  return in;
}

/// A control::BridgeCommand, its choices as numbers: what a broken program sends is no choice that there is not.
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

/// The same of control::LegCommands.
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

/// What a core says first: both sides mean the same structs.
struct CoreGreeting {
  std::uint32_t word = 0x73697873;  ///< "sixs"
  std::uint32_t call_bytes = 0, answer_bytes = 0;
};

}  // namespace sixstep::rig

// SPDX-License-Identifier: Apache-2.0
// The wiring between board and motor: the phase at each leg, and the Hall probe at each pin (model.md 7).
// Legs a, b, c and pins H1, H2, H3 are names of the board; phases and probes are names of the motor. Only a
// rig with the general kernel can have exchanged wires. With the lean kernel the wires are straight and need
// no computing time.
#pragma once
#include <array>
#include <cstddef>
#include <cstdint>

#include "sixstep/plant/state.hpp"

namespace sixstep::plant::general {
template <class Real>
class Plant;
}  // namespace sixstep::plant::general

namespace sixstep::rig {

/// Order of the motor's phases at legs a, b, c, or of probes 1, 2, 3 (as a, b, c) at pins H1, H2, H3.
enum class WireOrder : std::uint8_t { abc, bca, cab, acb, cba, bac };

/// Index of the phase or probe at each leg or pin.
constexpr std::array<std::uint8_t, 3> ends_of(WireOrder order) {
  constexpr std::array<std::uint8_t, 3> ends[] = {{0, 1, 2}, {1, 2, 0}, {2, 0, 1},
                                                  {0, 2, 1}, {2, 1, 0}, {1, 0, 2}};
  return ends[static_cast<std::size_t>(order)];
}

/// Code of probes 1, 2, 3 from the levels at pins H1, H2, H3, with the probes connected in this order.
constexpr std::uint8_t code_at(WireOrder order, std::uint8_t pins) {
  unsigned code = 0;
  for (unsigned pin = 0; pin < 3; ++pin) code |= (pins >> (2U - pin) & 1U) << (2U - ends_of(order)[pin]);
  return static_cast<std::uint8_t>(code);
}

/// Converts between phases and legs, and between probes and pins.
struct Wiring {
  WireOrder phases = WireOrder::abc;  ///< phases at legs a, b, c
  WireOrder probes = WireOrder::abc;  ///< probes at pins H1, H2, H3
  std::uint8_t inverted = 0;  ///< mask of the pins, as bits of a Hall code, at which the probe's signal is
                              ///< inverted

  bool operator==(const Wiring&) const = default;

  /// Phase of the motor at this leg.
  std::size_t phase(std::size_t leg) const { return ends_of(phases)[leg]; }

  /// Converts quantities from the order of the phases to the order of the legs.
  template <class T>
  std::array<T, 3> at_legs(const std::array<T, 3>& of_phases) const {
    return {of_phases[phase(0)], of_phases[phase(1)], of_phases[phase(2)]};
  }
  plant::Gates at_legs(const plant::Gates& of_phases) const {
    plant::Gates legs;
    for (std::size_t k = 0; k < 3; ++k) {
      legs.high[k] = of_phases.high[phase(k)];
      legs.low[k] = of_phases.low[phase(k)];
    }
    return legs;
  }
  /// The motor's state with its currents ordered by the board's legs; speed, angle and bus are unchanged.
  template <class Real>
  plant::State<Real> at_legs(const plant::State<Real>& state) const {
    plant::State<Real> seen = state;
    seen.i = at_legs(state.i);
    seen.i_low = at_legs(state.i_low);
    return seen;
  }
  plant::Gates at_phases(const plant::Gates& of_legs) const {
    plant::Gates phases_gates;
    for (std::size_t k = 0; k < 3; ++k) {
      phases_gates.high[phase(k)] = of_legs.high[k];
      phases_gates.low[phase(k)] = of_legs.low[k];
    }
    return phases_gates;
  }
  /// Converts a code of the probes to the code at the pins. Bits 2, 1, 0 are probes 1, 2, 3, and H1, H2, H3.
  std::uint8_t at_pins(std::uint8_t probe_code) const {
    unsigned pins = 0;
    for (unsigned pin = 0; pin < 3; ++pin)
      pins |= (probe_code >> (2U - ends_of(probes)[pin]) & 1U) << (2U - pin);
    return static_cast<std::uint8_t>(pins ^ inverted);
  }
};

/// Wiring without exchanged wires: all conversions return their argument.
struct StraightWiring {
  static constexpr std::size_t phase(std::size_t leg) { return leg; }
  template <class T>
  static constexpr const T& at_legs(const T& of_phases) {
    return of_phases;
  }
  static constexpr const plant::Gates& at_phases(const plant::Gates& of_legs) { return of_legs; }
  static constexpr std::uint8_t at_pins(std::uint8_t probe_code) { return probe_code; }
};

/// Type of a rig's wires, by its plant.
template <class Plant>
struct WiringFor {
  using type = StraightWiring;
};
template <class Real>
struct WiringFor<plant::general::Plant<Real>> {
  using type = Wiring;
};

}  // namespace sixstep::rig

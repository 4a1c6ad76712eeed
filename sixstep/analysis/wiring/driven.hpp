// SPDX-License-Identifier: Apache-2.0
// Lists the 36 ways to connect a motor to a drive that commutates by Hall probes, and finds which pair of the
// motor's phases the drive drives in each sector. The drive's own table (control/commutation.hpp) and the
// rig's wires (rig/wiring.hpp) determine this pair.
#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>

#include "sixstep/rig/wiring.hpp"

namespace sixstep::analysis {

inline constexpr std::size_t ways_to_plug_in = 36;

/// A row of the drive's commutation table, for display: legs 0, 1, 2 are a, b, c. A negative command swaps
/// high and low.
struct Commutation {
  std::uint8_t code = 0;  ///< H1 H2 H3 as bits 2, 1, 0
  std::size_t high = 0, low = 0, floating = 0;
};
Commutation commutation(std::uint8_t sector);

/// All wirings, with phases in the outer and probes in the inner loop. In each loop the orders with the
/// sequence a, b, c come first, then the orders with two swapped wires.
std::array<rig::Wiring, ways_to_plug_in> all_wirings();

/// True if the order keeps the sequence of the three wires, possibly shifted.
constexpr bool keeps_the_turn(rig::WireOrder order) {
  return order == rig::WireOrder::abc || order == rig::WireOrder::bca || order == rig::WireOrder::cab;
}

/// The pair that the drive drives in one sector of the rotor.
struct Driven {
  std::uint8_t seen = 0;             ///< the sector of the code at the pins
  std::size_t source = 0, sink = 0;  ///< phases of the motor
  int ahead = 0;                     ///< number of sectors, 0..5, from the rotor's sector to the sector in
                                     ///< which straight wires drive this pair
  bool operator==(const Driven&) const = default;
};

/// The driven pair for a positive command, 120 degree probes and no inverted pin.
Driven driven(const rig::Wiring& wiring, std::uint8_t sector);

/// Driven::ahead if it is the same in all six sectors. Empty if phases and probes have opposite sequences.
std::optional<int> sectors_ahead(const rig::Wiring& wiring);

}  // namespace sixstep::analysis

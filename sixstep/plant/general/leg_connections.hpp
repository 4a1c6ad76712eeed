// SPDX-License-Identifier: Apache-2.0
// What a leg may be connected by, from its gates and the kind of its devices (model.md 2 and 8).
#pragma once
#include "sixstep/plant/general/machine.hpp"

namespace sixstep::plant::general {

/// What a leg without current may become, by its gates: the connection that carries a positive current and the one that
/// carries a negative one.
struct LegConnections {
  Connection positive = Connection::low_diode, negative = Connection::high_diode;
};
inline LegConnections ways_of(const Devices& devices, bool gate_high, bool gate_low) {
  if (devices.igbt && gate_high) return {Connection::high_switch, Connection::high_diode};
  if (devices.igbt && gate_low) return {Connection::low_diode, Connection::low_switch};
  return {};
}

/// Whether a connection carries one direction only, and which: 1, -1; 0 for a MOSFET's channel.
inline int direction_of(const Devices& devices, Connection c) {
  if (c == Connection::low_diode) return 1;
  if (c == Connection::high_diode) return -1;
  if (!devices.igbt || is_floating(c)) return 0;
  return c == Connection::high_switch ? 1 : -1;
}

}  // namespace sixstep::plant::general

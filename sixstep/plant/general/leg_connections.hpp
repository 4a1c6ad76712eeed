// SPDX-License-Identifier: Apache-2.0
// Possible connections of a leg, from its gates and the kind of its devices (model.md 2 and 8).
#pragma once
#include "sixstep/plant/general/machine.hpp"

namespace sixstep::plant::general {

/// Connections that a leg without current changes to when a positive or a negative current begins.
struct LegConnections {
  Connection positive = Connection::low_diode, negative = Connection::high_diode;
};
inline LegConnections ways_of(const Devices& devices, bool gate_high, bool gate_low) {
  if (devices.igbt && gate_high) return {Connection::high_switch, Connection::high_diode};
  if (devices.igbt && gate_low) return {Connection::low_diode, Connection::low_switch};
  return {};
}

/// Direction of the current in a connection: 1 or -1 for a device that conducts only one direction, 0 for a
/// MOSFET's channel or a floating leg.
inline int direction_of(const Devices& devices, Connection c) {
  if (c == Connection::low_diode) return 1;
  if (c == Connection::high_diode) return -1;
  if (!devices.igbt || is_floating(c)) return 0;
  return c == Connection::high_switch ? 1 : -1;
}

}  // namespace sixstep::plant::general

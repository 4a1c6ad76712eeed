// SPDX-License-Identifier: Apache-2.0
// Finds the conducting devices in each leg of the bridge, from gates and currents of the rows.
#pragma once
#include <array>
#include <cstdint>
#include <vector>

#include "sixstep/study/measure/trace.hpp"

namespace report {

/// The legs' connections from time_s[n] to time_s[n + 1], or to the end: code[n] = a + 5 b + 25 c, each a
/// plant::Connection. web/bridge.js depends on the order of plant::Connection.
struct Conduction {
  std::vector<double> time_s;
  std::vector<std::uint8_t> code;
  double end_s = 0.0;
};

/// Every change of conduction in the run; empty if the trace has no gates or currents. An IGBT that is on
/// carries current in one direction only, and its diode in the other. Leg k carries the current of phase
/// phase_at[k], which is connected to it.
Conduction conduction(const sixstep::study::Trace& trace, bool igbt = false,
                      const std::array<std::uint8_t, 3>& phase_at = {0, 1, 2});

}  // namespace report

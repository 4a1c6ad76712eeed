// SPDX-License-Identifier: Apache-2.0
// Computes from the gates and currents of the rows which devices conduct in each leg of the bridge.
#pragma once
#include <array>
#include <cstdint>
#include <vector>

#include "sixstep/study/measure/trace.hpp"

namespace report {

/// The legs' connections. code[n] applies from time_s[n] to time_s[n + 1], or to the end: code[n] = a + 5 b +
/// 25 c, where a, b, c are the plant::Connection of legs a, b, c. web/bridge.js depends on the order of
/// plant::Connection.
struct Conduction {
  std::vector<double> time_s;
  std::vector<std::uint8_t> code;
  double end_s = 0.0;
};

/// All changes of conduction in the run; empty if the trace contains no gates or no currents. An IGBT that is
/// on conducts in one direction only, and its diode in the other. Leg k carries the current of phase
/// phase_at[k], which is connected to the leg.
Conduction conduction(const sixstep::study::Trace& trace, bool igbt = false,
                      const std::array<std::uint8_t, 3>& phase_at = {0, 1, 2});

}  // namespace report

// SPDX-License-Identifier: Apache-2.0
// What conducts in each leg of the bridge, from gates and currents of the rows.
#pragma once
#include <cstdint>
#include <vector>

#include "sixstep/study/measure/trace.hpp"

namespace report {

/// How a leg carries its current: by a switch that is on, else by the diode the current's sign opens.
enum class Leg : std::uint8_t { floating, upper_switch, lower_switch, upper_diode, lower_diode };

/// From time_s[n] on, to time_s[n + 1] or the end, the legs are as code[n] says: a + 5 b + 25 c.
struct Conduction {
  std::vector<double> time_s;
  std::vector<std::uint8_t> code;
  double end_s = 0.0;
};

/// Every change of the run; empty where the trace has no gates or currents.
Conduction conduction(const sixstep::study::Trace& trace);

}  // namespace report

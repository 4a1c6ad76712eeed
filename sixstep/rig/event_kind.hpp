// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstdint>

namespace sixstep::rig {

/// Kinds of events, for the run's statistics.
enum class EventKind : std::uint8_t {
  sector_edge,
  diode_off,
  standstill,
  breakaway,
  comparator,
  tick,
  pwm_edge,
  count
};

}  // namespace sixstep::rig

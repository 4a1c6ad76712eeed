// SPDX-License-Identifier: Apache-2.0
// Hall edges of a rotor by their definition (model.md 3 and 10). Edge n is at 60 n degrees plus three angles:
// an offset, the edge's misplacement, and half the hysteresis in the direction of motion. The edge is
// detected after a delay.
#pragma once
#include <cmath>
#include <cstdint>
#include <vector>

namespace sixstep::control {

struct HallProbes {
  double own_deg[6]{};
  double offset_deg = 0;
  double half_hysteresis_deg = 0;
  double delay_s = 0;

  double at(int edge) const { return 60.0 * edge + offset_deg + own_deg[((edge % 6) + 6) % 6]; }
};

struct SeenEdge {
  std::uint8_t sector, edge;
  std::int8_t direction;
  std::uint32_t time;  ///< timer counts; wraps soon after the start
};

constexpr double timer_Hz = 1e6;
inline std::uint32_t ticks_at(double s) {
  return static_cast<std::uint32_t>(static_cast<std::uint64_t>(s * timer_Hz) + 0xffff0000u);
}

/// The detection of edge m (of any turn) that the rotor passes at `passed_s`.
inline SeenEdge seen(const HallProbes& probes, int m, int direction, double passed_s) {
  const int sector = direction > 0 ? m : m - 1;
  return {static_cast<std::uint8_t>(((sector % 6) + 6) % 6), static_cast<std::uint8_t>(((m % 6) + 6) % 6),
          static_cast<std::int8_t>(direction), ticks_at(passed_s + probes.delay_s)};
}

/// The angle at which a rotor turning in `direction` switches edge m, in degrees.
inline double switches(const HallProbes& probes, int m, int direction) {
  return probes.at(m) + direction * probes.half_hysteresis_deg;
}

}  // namespace sixstep::control

// SPDX-License-Identifier: Apache-2.0
// Terminal voltages, in counts of the converter, of a rotor with prescribed motion. The code follows model.md
// 1 and 2, and is independent of the tested code.
#pragma once
#include <cmath>
#include <cstdint>

#include "sixstep/control/sensorless/zero_crossing.hpp"

namespace sixstep::testing {

inline constexpr std::uint16_t bus_counts = 3200;

/// The trapezoid of phase k with a flat top of 120 degrees.
inline double emf_shape(double electrical_deg, int k) {
  const double from_top = std::remainder(electrical_deg - 120.0 * k - 60.0, 360.0);
  return std::fmax(-1.0, std::fmin(1.0, (90.0 - std::fabs(from_top)) / 30.0));
}

inline std::uint16_t held_to_rails(double counts) {
  return static_cast<std::uint16_t>(
      std::fmin(static_cast<double>(bus_counts), std::fmax(0.0, std::floor(counts + 0.5))));
}

/// The pair of a sector is connected to the rails, and the third leg floats. `emf` is the back-EMF on the
/// flat top, in counts, with the sign of the rotation.
inline control::TerminalSample driven_sample(std::uint8_t sector, double electrical_deg, double emf,
                                             std::uint32_t at) {
  constexpr int pairs[6][2] = {{0, 1}, {0, 2}, {1, 2}, {1, 0}, {2, 0}, {2, 1}};
  control::TerminalSample s;
  s.bus = bus_counts;
  s.at = at;
  const int source = pairs[sector][0], sink = pairs[sector][1], floating = 3 - source - sink;
  const double star =
      (bus_counts - emf * (emf_shape(electrical_deg, source) + emf_shape(electrical_deg, sink))) / 2;
  s.u[source] = bus_counts;
  s.u[sink] = 0;
  s.u[floating] = held_to_rails(star + emf * emf_shape(electrical_deg, floating));
  return s;
}

/// All legs float, because the bridge is off.
inline control::TerminalSample coasting_sample(double electrical_deg, double emf, std::uint32_t at) {
  control::TerminalSample s;
  s.bus = bus_counts;
  s.at = at;
  for (int k = 0; k < 3; ++k) s.u[k] = held_to_rails(bus_counts / 2.0 + emf * emf_shape(electrical_deg, k));
  return s;
}

}  // namespace sixstep::testing

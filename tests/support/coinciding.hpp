// SPDX-License-Identifier: Apache-2.0
// Runs in which two events occur at one instant, exactly or within rounding.
#pragma once
#include <cmath>

#include "tests/support/board.hpp"

namespace sixstep::testing {

inline constexpr std::int64_t period_ticks = 30'000'000;
inline constexpr double us = 1e-6, ns = 1e-9;

inline Board locked(Board b) {
  b.shaft.locked = true;
  b.start.angle_rad = 0.02;  // sector 0: pair a to b
  return b;
}

/// No torque changes the speed, so it is constant (2 K_e w = 10 V). The edge from sector 0 to sector 1 is at
/// `edge_s`.
inline Board turning(Board b, double edge_s) {
  b.shaft.J_kg_m2 = 1e9;
  b.shaft.B_Nm_s = 0.0;
  b.start.speed_rad_s = 300.0;
  b.start.angle_rad = at_electrical_deg(60.0) - 300.0 * edge_s;
  return b;
}

/// A current rises by U - E and falls by U + E (bus voltage U, back-EMF E). Returns the on-time after which
/// the current is zero again at `zero_s`.
inline double on_time_for_zero(const Drivetrain& d, double E, double zero_s) {
  const double U = 24.0, R = d.R_tt(), tau = d.tau();
  double low = 0, high = zero_s;
  for (int n = 0; n < 200; ++n) {
    const double on = low + (high - low) / 2, i = -(U - E) / R * std::expm1(-on / tau);
    (on + tau * std::log1p(i * R / (U + E)) > zero_s ? high : low) = on;
  }
  return low;
}

}  // namespace sixstep::testing

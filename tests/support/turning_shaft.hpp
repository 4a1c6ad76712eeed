// SPDX-License-Identifier: Apache-2.0
// A shaft with a closed-form motion. The motion is passed to the ports of a board segment by segment.
#pragma once
#include <cmath>

#include "sixstep/rig/shaft_ports.hpp"

namespace sixstep::testing {

/// The mechanical angle is theta(t) = theta_0 + w t + a t^2/2, in segments of 10 us.
struct Motion {
  static constexpr std::int64_t p = 8;  ///< pole pairs
  double theta_0 = 0, w = 0, a = 0;

  double theta(double t) const { return theta_0 + (w + a * t / 2) * t; }
  /// The sector and the angle within the sector at the time t.
  plant::ShaftAngle<double> shaft(double t) const {
    const double sectors = theta(t) * p / base::sector_rad;
    const auto sector = static_cast<std::int64_t>(std::floor(sectors));
    return {sector, theta(t) * p - static_cast<double>(sector) * base::sector_rad, p};
  }
  /// Passes the motion to the ports. With a gear, the side of the load follows through the gear and through a
  /// coupling with a constant twist.
  void show(rig::ShaftPorts& ports, double from_s, double to_s, double sample_s = 1.0, double gear = 0.0,
            double twist_rad = 0.0) const {
    const double h = 10e-6;
    for (double t = from_s; t < to_s - h / 2; t += h) {
      plant::Expansion<double> y;
      y.degree = 2;
      y.h = h;
      const plant::ShaftAngle<double> at = shaft(t);
      y.x[0] = at.x;
      y.x[1] = p * (w + a * t) * h;
      y.x[2] = p * a * h * h / 2;
      y.w[0] = w + a * t;
      y.w[1] = a * h;
      y.w[2] = 0;
      rig::ShaftMotion<double> motion{
          y, at.sector, p, 1.0, sim::to_instant(t), sim::to_instant(t + h), sim::to_instant(sample_s)};
      series::Coefficients<double> speed{}, twist{};
      twist[0] = twist_rad;
      if (gear > 0) {
        for (int n = 0; n <= 2; ++n) speed[n] = y.w[n] / gear;
        motion.load = {&speed, &twist, 1 / gear};
      }
      ports.follow(motion);
    }
  }
};

}  // namespace sixstep::testing

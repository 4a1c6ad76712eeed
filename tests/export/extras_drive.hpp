// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "sixstep/design/scaling/scaling.hpp"

namespace extras {

/// A speed drive with every extra function. All its numbers differ, so that an exchange is detected.
inline sixstep::control::DriveConfig<double> drive() {
  using namespace sixstep::control;
  DriveConfig<double> d;
  d.mode = Mode::speed;
  d.chopping = Chopping::complementary;
  d.current = {4.0956, -3.6940, 24.0};
  d.nominal_bus_V = 24.5;
  d.speed = {0.0158299, -0.0156961, 0.97};
  d.current_at_full_torque_A = 23.3;
  d.current_limit_A = 10.0;
  d.extras = {.on = true,
              .slews_setpoint = true,
              .slew = {0.11},
              .limits_current = true,
              .limits = {9.5, true, 650.0, 0.31, true, 28.0, 5.25},
              .torque_fraction_per_A = 1 / 23.3,
              .feed_forward = {0.0335},
              .bus = {11.0},
              .smooth_chopping = true,
              .chopping = {0.75, 0.5},
              .pwm = {PwmPattern::pwm_on_pwm, 0.00046},
              .steps_commutation = true,
              .commutation = {0.034, 0.75, 0.08, 24.0, 1.2, 2e-4, 2e-4, 0.25},
              .speed_law = SpeedLaw::positional,
              .speed = {0.0158, 0.00013, 0.0085, 0.96, 0.00013 - 0.0085 * 0.0158},
              .speed_derivative = {0.0021, 0.031}};
  return d;
}

inline constexpr sixstep::design::OperatingRange range{
    .current_A = 20.1, .speed_rad_s = 850, .bus_V = 40, .setpoint = 600};

}  // namespace extras

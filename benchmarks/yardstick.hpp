// SPDX-License-Identifier: Apache-2.0
// The common part of both yardsticks: parameters of motor and bridge, and the thesis's cascade as the
// controller. The solvers share no code: rk4_textbook.hpp is written plainly, rk4_tuned.hpp is optimised.
#pragma once
#include <array>
#include <cstddef>
#include <cstdint>

namespace benchmarks {

enum class YardstickMode : std::uint8_t { duty, current, speed };

/// Defaults: maxon EC 45 flat 251601 at 24 V, ideal devices, soft chopping, 30 us period, the thesis's gains.
struct YardstickParameters {
  double R = 0.515, L = 0.286e-3, K_e = 0.01675, pole_pairs = 8.0;  // per phase
  double J = 1.35e-5, B = 7.3e-6;
  double U = 24.0, R_on = 0.0, V_f = 0.0, r_d = 0.0;
  double T_load = 0.0;
  double step_s = 1e-6;
  int steps_per_period = 30;
  YardstickMode mode = YardstickMode::duty;
  bool floating_phase_conducts =
      true;  // true: a free phase can start to conduct; false: it cannot, as in most textbook programs
  double current_d1 = 4.5, current_d0 = -4.04;      // A -> V
  double speed_d1 = 0.017225, speed_d0 = -0.01707;  // rad/s -> fraction of full torque
  double current_at_full_torque = 0.78 / 0.0335;
};

/// Driven pair (source, sink) of each sector for positive torque.
inline constexpr std::array<std::array<std::uint8_t, 2>, 6> yardstick_pairs{
    {{0, 1}, {0, 2}, {1, 2}, {1, 0}, {2, 0}, {2, 1}}};

/// The controller, once per PWM period.
class YardstickControl {
 public:
  /// Signed duty for a reference in the mode's unit, the motor current and the speed.
  double duty(const YardstickParameters& p, double reference, double current, double speed) {
    if (p.mode == YardstickMode::duty) return reference;
    double i_ref = reference;
    if (p.mode == YardstickMode::speed)
      i_ref = p.current_at_full_torque * speed_(p.speed_d1, p.speed_d0, reference - speed, 1.0);
    return current_(p.current_d1, p.current_d0, i_ref - current, p.U) / p.U;
  }

 private:
  struct Pi {
    double u = 0.0, e = 0.0;
    double operator()(double d1, double d0, double error, double limit) {
      u += d1 * error + d0 * e;
      u = u > limit ? limit : u < -limit ? -limit : u;
      e = error;
      return u;
    }
  };
  Pi current_, speed_;
};

}  // namespace benchmarks

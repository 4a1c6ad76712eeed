// SPDX-License-Identifier: Apache-2.0
// The faster yardstick: the same star machine, bridge and cascade as a textbook program. Fixed-step
// fourth-order Runge-Kutta, if statements for the diodes, gates and diodes constant over a step. It is
// optimised: no branch within a stage, back-EMF from a table of straight lines, angle relative to the
// sector's start. It includes an effect that is often left out: the free phase that starts to conduct. Its
// error is still of first order in the step, because switching instants are between the steps.
#pragma once
#include <array>
#include <cstddef>
#include <cstdint>

#include "benchmarks/yardstick.hpp"

namespace benchmarks {

class Rk4Tuned {
 public:
  explicit Rk4Tuned(const YardstickParameters& parameters)
      : p_(parameters), inv_L_(1.0 / parameters.L), inv_J_(1.0 / parameters.J) {}

  /// Duty in [-1, 1], current in A or speed in rad/s, depending on the mode. It takes effect at the next
  /// control tick.
  void set_reference(double value) { reference_ = value; }

  /// Advances by one fixed step.
  void step() {
    if (step_in_period_ == 0) control();
    set_legs(step_in_period_ + 0.5 < on_steps_);  // the on-time, rounded to a step
    integrate();
    stop_diodes();
    pass_sector_edges();
    if (++step_in_period_ == p_.steps_per_period) step_in_period_ = 0;
  }

  double current(std::size_t phase) const { return y_[phase]; }
  double speed() const { return y_[3]; }
  double angle() const { return (static_cast<double>(turns_of_sixty_) * sixty + y_[4]) / p_.pole_pairs; }

 private:
  using State = std::array<double, 5>;  // i_a, i_b, i_c, w, electrical angle since the sector's start
  static constexpr double sixty = 1.0471975511965976;

  /// Back-EMF shape f_k = start + slope x over each sector of the 120 degree trapezoid; x: electrical angle
  /// since the sector's start.
  struct Line {
    std::array<double, 3> start, slope;
  };
  static constexpr double ramp = 2.0 / sixty;
  static constexpr std::array<Line, 6> shape{{{{1, -1, 1}, {0, 0, -ramp}},
                                              {{1, -1, -1}, {0, ramp, 0}},
                                              {{1, 1, -1}, {-ramp, 0, 0}},
                                              {{-1, 1, -1}, {0, 0, ramp}},
                                              {{-1, 1, 1}, {0, -ramp, 0}},
                                              {{-1, -1, 1}, {ramp, 0, 0}}}};
  void control() {
    const auto [source, sink] = yardstick_pairs[sector_];
    const double d = control_.duty(p_, reference_, 0.5 * (y_[source] - y_[sink]), y_[3]);
    reversed_ = d < 0.0;
    on_steps_ = (reversed_ ? -d : d) * p_.steps_per_period;
  }

  void connect(std::size_t k, double voltage, double resistance) {
    connected_[k] = 1.0;
    voltage_[k] = voltage;
    resistance_[k] = resistance;
  }

  /// Sets the rail to which each leg is connected during this step. Switches follow the gates, and diodes
  /// follow the current's sign. If the terminal of a floating leg would be beyond a rail, its diode conducts.
  void set_legs(bool on) {
    const std::size_t source = yardstick_pairs[sector_][reversed_ ? 1 : 0],
                      sink = yardstick_pairs[sector_][reversed_ ? 0 : 1];
    connected_ = {};
    diode_ = {};
    for (std::size_t k = 0; k < 3; ++k) {
      if (k == sink) {
        connect(k, 0.0, p_.R_on);
      } else if (k == source && on) {
        connect(k, p_.U, p_.R_on);
      } else if (y_[k] > 0.0) {
        connect(k, -p_.V_f, p_.r_d);
        diode_[k] = 1;
      } else if (y_[k] < 0.0) {
        connect(k, p_.U + p_.V_f, p_.r_d);
        diode_[k] = -1;
      }
    }
    count_connected();
    if (p_.floating_phase_conducts && inv_count_ > 0.34) start_diodes();
  }

  void count_connected() { inv_count_ = 1.0 / (connected_[0] + connected_[1] + connected_[2]); }

  void start_diodes() {
    const Line& f = shape[sector_];
    std::array<double, 3> e;
    double star = 0.0;
    for (std::size_t k = 0; k < 3; ++k) {
      e[k] = p_.K_e * y_[3] * (f.start[k] + f.slope[k] * y_[4]);
      star += connected_[k] * (voltage_[k] - resistance_[k] * y_[k] - e[k]);
    }
    star *= inv_count_;
    for (std::size_t k = 0; k < 3; ++k) {
      if (connected_[k] != 0.0) continue;
      const double terminal = star + e[k];
      if (terminal < -p_.V_f) {
        connect(k, -p_.V_f, p_.r_d);
        diode_[k] = 1;
      } else if (terminal > p_.U + p_.V_f) {
        connect(k, p_.U + p_.V_f, p_.r_d);
        diode_[k] = -1;
      }
    }
    count_connected();
  }

  /// Derivatives of the state (phase k): L di_k/dt = u_k - u_n - R i_k - e_k, where u_n is the mean of u_k -
  /// e_k over the connected legs; J dw/dt = T_e - B w - T_load.
  State rate(const State& y) const {
    const Line& line = shape[sector_];
    const double emf = p_.K_e * y[3];
    const double f_a = line.start[0] + line.slope[0] * y[4], f_b = line.start[1] + line.slope[1] * y[4],
                 f_c = line.start[2] + line.slope[2] * y[4];
    const double v_a = voltage_[0] - resistance_[0] * y[0] - emf * f_a;
    const double v_b = voltage_[1] - resistance_[1] * y[1] - emf * f_b;
    const double v_c = voltage_[2] - resistance_[2] * y[2] - emf * f_c;
    const double star = (connected_[0] * v_a + connected_[1] * v_b + connected_[2] * v_c) * inv_count_;
    const double torque = p_.K_e * (f_a * y[0] + f_b * y[1] + f_c * y[2]);
    return {connected_[0] * (v_a - star - p_.R * y[0]) * inv_L_,
            connected_[1] * (v_b - star - p_.R * y[1]) * inv_L_,
            connected_[2] * (v_c - star - p_.R * y[2]) * inv_L_, (torque - p_.B * y[3] - p_.T_load) * inv_J_,
            p_.pole_pairs * y[3]};
  }

  static State moved(const State& y, const State& k, double h) {
    return {y[0] + h * k[0], y[1] + h * k[1], y[2] + h * k[2], y[3] + h * k[3], y[4] + h * k[4]};
  }

  void integrate() {
    const double h = p_.step_s;
    const State k1 = rate(y_), k2 = rate(moved(y_, k1, h / 2)), k3 = rate(moved(y_, k2, h / 2)),
                k4 = rate(moved(y_, k3, h));
    for (std::size_t n = 0; n < 5; ++n) y_[n] += h / 6 * (k1[n] + 2.0 * (k2[n] + k3[n]) + k4[n]);
  }

  /// A diode whose current has changed its sign during the step has stopped. The other two legs carry the
  /// same current.
  void stop_diodes() {
    for (std::size_t k = 0; k < 3; ++k) {
      if (diode_[k] * y_[k] >= 0.0) continue;
      const std::size_t a = (k + 1) % 3, b = (k + 2) % 3;
      y_[k] = 0.0;
      const double shared = connected_[a] * connected_[b] * 0.5 * (y_[a] - y_[b]);
      y_[a] = shared;
      y_[b] = -shared;
    }
  }

  void pass_sector_edges() {
    if (y_[4] >= sixty) {
      y_[4] -= sixty;
      ++turns_of_sixty_;
      sector_ = sector_ == 5 ? 0 : sector_ + 1;
    } else if (y_[4] < 0.0) {
      y_[4] += sixty;
      --turns_of_sixty_;
      sector_ = sector_ == 0 ? 5 : sector_ - 1;
    }
  }

  YardstickParameters p_;
  double inv_L_, inv_J_;
  State y_{};
  std::size_t sector_ = 0;
  std::int64_t turns_of_sixty_ = 0;
  int step_in_period_ = 0;
  double reference_ = 0.0, on_steps_ = 0.0;
  bool reversed_ = false;
  YardstickControl control_;
  std::array<double, 3> connected_{}, voltage_{}, resistance_{};
  std::array<int, 3> diode_{};
  double inv_count_ = 0.0;
};

}  // namespace benchmarks

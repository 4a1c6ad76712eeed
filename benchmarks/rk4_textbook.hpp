// SPDX-License-Identifier: Apache-2.0
// The plain yardstick, as a competent user writes it. It has the equations in phase quantities, one function
// for the derivatives with if statements for switches and diodes, and the back-EMF from a table over the
// electrical turn. The method is the classic fourth-order Runge-Kutta with a fixed step. Currents of diodes
// that have stopped are set to zero. A free phase can start to conduct. The program is neither optimised nor
// slowed down; docs/explanation/performance.md states what it costs at best.
#pragma once
#include <array>
#include <cmath>
#include <cstddef>

#include "benchmarks/yardstick.hpp"

namespace benchmarks {

class Rk4Textbook {
 public:
  explicit Rk4Textbook(const YardstickParameters& parameters) : p_(parameters) {}

  /// Duty in [-1, 1], current in A or speed in rad/s, depending on the mode. It takes effect at the next
  /// control tick.
  void set_reference(double value) { reference_ = value; }

  /// Advances by one fixed step.
  void step() {
    if (step_in_period_ == 0) {
      const auto [source, sink] = yardstick_pairs[sector()];
      duty_ = control_.duty(p_, reference_, 0.5 * (y_[source] - y_[sink]), y_[3]);
    }
    set_gates(step_in_period_ + 0.5 < std::fabs(duty_) * p_.steps_per_period);
    runge_kutta();
    clip_diodes();
    wrap_angle();
    if (++step_in_period_ == p_.steps_per_period) step_in_period_ = 0;
  }

  double current(std::size_t phase) const { return y_[phase]; }
  double speed() const { return y_[3]; }
  double angle() const { return (turn * static_cast<double>(turns_) + y_[4]) / p_.pole_pairs; }

 private:
  using State = std::array<double, 5>;  // i_a, i_b, i_c, w, electrical angle within the turn
  static constexpr double turn = 6.283185307179586;

  /// Shape of the back-EMF of the three phases at every 60 electrical degrees, with straight lines between.
  /// The first two entries are repeated at the end.
  static constexpr std::array<std::array<double, 3>, 8> shape{
      {{1, -1, 1}, {1, -1, -1}, {1, 1, -1}, {-1, 1, -1}, {-1, 1, 1}, {-1, -1, 1}, {1, -1, 1}, {1, -1, -1}}};

  /// An angle in sixths of a turn, in [0, 6). A stage may reach slightly beyond the turn in which its step
  /// began.
  static double sixths(double angle) {
    const double x = angle * (6.0 / turn);
    return x < 0.0 ? x + 6.0 : x >= 6.0 ? x - 6.0 : x;
  }
  std::size_t sector() const { return static_cast<std::size_t>(static_cast<int>(sixths(y_[4]))); }

  static std::array<double, 3> back_emf_shape(double angle) {
    const double x = sixths(angle);
    const int n = static_cast<int>(x);
    const double part = x - n;
    const std::array<double, 3>&from = shape[static_cast<std::size_t>(n)],
                             &to = shape[static_cast<std::size_t>(n + 1)];
    return {from[0] + part * (to[0] - from[0]), from[1] + part * (to[1] - from[1]),
            from[2] + part * (to[2] - from[2])};
  }

  void set_gates(bool on) {
    const std::size_t n = sector();
    const std::size_t source = yardstick_pairs[n][duty_ < 0 ? 1 : 0],
                      sink = yardstick_pairs[n][duty_ < 0 ? 0 : 1];
    high_ = low_ = {};
    high_[source] = on;
    low_[sink] = true;
  }

  State derivatives(const State& y) const {
    const std::array<double, 3> f = back_emf_shape(y[4]);
    std::array<double, 3> e, u{};
    std::array<bool, 3> connected{};
    for (std::size_t k = 0; k < 3; ++k) {
      e[k] = p_.K_e * y[3] * f[k];
      connected[k] = true;
      if (high_[k])
        u[k] = p_.U - p_.R_on * y[k];
      else if (low_[k])
        u[k] = -p_.R_on * y[k];
      else if (y[k] > 0)
        u[k] = -p_.V_f - p_.r_d * y[k];
      else if (y[k] < 0)
        u[k] = p_.U + p_.V_f - p_.r_d * y[k];
      else
        connected[k] = false;
    }
    if (p_.floating_phase_conducts) start_diodes(e, u, connected);
    const double u_n = star_point(e, u, connected);
    State rate{};
    double torque = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      if (connected[k]) rate[k] = (u[k] - u_n - p_.R * y[k] - e[k]) / p_.L;
      torque += p_.K_e * f[k] * y[k];
    }
    rate[3] = (torque - p_.B * y[3] - p_.T_load) / p_.J;
    rate[4] = p_.pole_pairs * y[3];
    return rate;
  }

  /// Star-point voltage u_n: the mean of u_k - e_k over the connected legs (u_k: terminal voltage, e_k:
  /// back-EMF of phase k).
  static double star_point(const std::array<double, 3>& e, const std::array<double, 3>& u,
                           const std::array<bool, 3>& connected) {
    double sum = 0;
    int count = 0;
    for (std::size_t k = 0; k < 3; ++k)
      if (connected[k]) {
        sum += u[k] - e[k];
        ++count;
      }
    return count > 0 ? sum / count : 0;
  }

  /// If a floating terminal's voltage is beyond a rail, its diode conducts.
  void start_diodes(const std::array<double, 3>& e, std::array<double, 3>& u,
                    std::array<bool, 3>& connected) const {
    if (connected[0] && connected[1] && connected[2]) return;
    const double u_n = star_point(e, u, connected);
    for (std::size_t k = 0; k < 3; ++k) {
      if (connected[k]) continue;
      const double terminal = u_n + e[k];
      if (terminal < -p_.V_f) {
        u[k] = -p_.V_f;
        connected[k] = true;
      } else if (terminal > p_.U + p_.V_f) {
        u[k] = p_.U + p_.V_f;
        connected[k] = true;
      }
    }
  }

  void runge_kutta() {
    const double h = p_.step_s;
    const auto moved = [this](const State& k, double by) {
      State y = y_;
      for (std::size_t n = 0; n < y.size(); ++n) y[n] += by * k[n];
      return y;
    };
    const State k1 = derivatives(y_);
    const State k2 = derivatives(moved(k1, h / 2));
    const State k3 = derivatives(moved(k2, h / 2));
    const State k4 = derivatives(moved(k3, h));
    before_ = y_;
    for (std::size_t n = 0; n < y_.size(); ++n) y_[n] += h / 6 * (k1[n] + 2 * k2[n] + 2 * k3[n] + k4[n]);
  }

  /// The current of a leg with both gates off cannot change its sign: its diode has stopped, and the other
  /// two legs carry the same current.
  void clip_diodes() {
    for (std::size_t k = 0; k < 3; ++k) {
      if (high_[k] || low_[k] || before_[k] * y_[k] >= 0) continue;
      const std::size_t a = (k + 1) % 3, b = (k + 2) % 3;
      const double shared = 0.5 * (y_[a] - y_[b]);
      const bool pair = (y_[a] != 0) && (y_[b] != 0);
      y_[k] = 0;
      y_[a] = pair ? shared : 0;
      y_[b] = pair ? -shared : 0;
    }
  }

  void wrap_angle() {
    if (y_[4] >= turn) {
      y_[4] -= turn;
      ++turns_;
    } else if (y_[4] < 0) {
      y_[4] += turn;
      --turns_;
    }
  }

  YardstickParameters p_;
  State y_{}, before_{};
  std::array<bool, 3> high_{}, low_{};
  long turns_ = 0;
  int step_in_period_ = 0;
  double reference_ = 0.0, duty_ = 0.0;
  YardstickControl control_;
};

}  // namespace benchmarks

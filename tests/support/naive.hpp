// SPDX-License-Identifier: Apache-2.0
// A textbook simulation of soft chopping by RK4. The sign of the current selects the diode. A leg without
// gate and without current remains off, although its terminal may exceed a rail. In reality, such a leg
// starts to conduct (model.md 2).
#pragma once
#include <array>
#include <cmath>

#include "tests/support/maxon.hpp"

namespace sixstep::testing {

class NaiveSoftChopper {
 public:
  NaiveSoftChopper(const Drivetrain& d, double step_s) : d_(d), h_(step_s) {}

  /// One step, with the upper switch of the source on or off. The step is split at the end of a sector, or
  /// when a diode's current reaches zero, so that the step size does not cause the deviation.
  void step(bool on) {
    double left = h_;
    for (int cuts = 0; left > 0 && cuts < 20; ++cuts) {
      const plant::Legs legs = connections(on);
      const State whole = rk4(legs, left);
      double low = 0, high = left;
      if (broken(whole, legs)) {
        for (int n = 0; n < 60 && low < high; ++n) {
          const double middle = low + (high - low) / 2;
          (broken(rk4(legs, middle), legs) ? high : low) = middle;
        }
      }
      const bool cut = high < left || broken(whole, legs);
      State next = cut ? rk4(legs, high) : whole;
      if (cut) stop_at_zero(next, legs);
      y_ = next;
      left -= high;
    }
  }
  double i(int k) const { return y_[k]; }
  double speed() const { return y_[3]; }

 private:
  using State = std::array<double, 5>;  // i_a, i_b, i_c, w, theta_e

  static double shape(double theta_e, int k) {
    const double d = std::fabs(std::remainder(theta_e * 180.0 / base::pi - 60.0 - 120.0 * k, 360.0));
    return d <= 60.0 ? 1.0 : d >= 120.0 ? -1.0 : (90.0 - d) / 30.0;
  }
  static State moved(State y, const State& rate, double h) {
    for (int n = 0; n < 5; ++n) y[n] += h * rate[n];
    return y;
  }
  plant::Legs connections(bool on) const {
    static constexpr int pair[6][2] = {{0, 1}, {0, 2}, {1, 2}, {1, 0}, {2, 0}, {2, 1}};
    const int sector = static_cast<int>(sector_of(y_)) % 6;
    plant::Legs legs;
    for (int k = 0; k < 3; ++k)
      legs[k] = plant::connection_of(on && k == pair[sector][0], k == pair[sector][1], y_[k]);
    return legs;
  }
  State rate(const State& y, const plant::Legs& legs) const {
    const plant::Machine& m = d_.machine;
    plant::PerLeg<double> i{y[0], y[1], y[2]}, e{};
    double torque = 0;
    for (int k = 0; k < 3; ++k) {
      const double f = shape(y[4], k);
      e[k] = m.K_e_V_s * y[3] * f;
      torque += m.K_e_V_s * f * y[k];
    }
    const auto poles = plant::pole_table<double>(d_.devices);
    const auto u = plant::pole_voltages(legs, poles, d_.supply.V_0_V, i, e);
    const double u_n = plant::star_voltage(legs, poles, d_.supply.V_0_V, i, e);
    State r{};
    for (int k = 0; k < 3; ++k)
      if (!plant::is_floating(legs[k])) r[k] = (u[k] - u_n - m.R_ohm * i[k] - e[k]) / m.L_H;
    r[3] = (torque - d_.shaft.B_Nm_s * y[3]) / d_.shaft.J_kg_m2;
    r[4] = m.pole_pairs * y[3];
    return r;
  }
  State rk4(const plant::Legs& legs, double h) const {
    const State k1 = rate(y_, legs), k2 = rate(moved(y_, k1, h / 2), legs),
                k3 = rate(moved(y_, k2, h / 2), legs), k4 = rate(moved(y_, k3, h), legs);
    State next = y_;
    for (int n = 0; n < 5; ++n) next[n] += h / 6 * (k1[n] + 2 * k2[n] + 2 * k3[n] + k4[n]);
    return next;
  }
  static bool beyond_zero(const State& y, plant::Connection leg, int k) {
    return (leg == plant::Connection::low_diode && y[k] <= 0) ||
           (leg == plant::Connection::high_diode && y[k] >= 0);
  }
  static double sector_of(const State& y) { return std::floor(y[4] / base::sector_rad); }
  bool broken(const State& next, const plant::Legs& legs) const {
    if (sector_of(next) != sector_of(y_)) return true;
    for (int k = 0; k < 3; ++k)
      if (beyond_zero(next, legs[k], k)) return true;
    return false;
  }
  static void stop_at_zero(State& next, const plant::Legs& legs) {
    for (int k = 0; k < 3; ++k) {
      if (!beyond_zero(next, legs[k], k)) continue;
      next[k] = 0;
      if (plant::connected_count(legs) == 2)
        next[0] = next[1] = next[2] = 0;
      else
        next[(k + 2) % 3] = -next[(k + 1) % 3];
    }
  }

  Drivetrain d_;
  double h_;
  State y_{};
};

}  // namespace sixstep::testing

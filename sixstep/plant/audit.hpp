// SPDX-License-Identifier: Apache-2.0
// Watches a run against the laws that hold for every one (MODEL 5): energy in = energy out, currents sum to
// zero, no diode conducts backwards. Exact integrals of the segments' own polynomials.
#pragma once
#include "sixstep/plant/plant.hpp"

namespace sixstep::plant {

/// Energy over a run, J. The residuals are what does not close, relative to the energy that moved.
struct EnergyBook {
  double supplied = 0.0;  ///< integral U_s i_dc dt, into the bridge
  double copper = 0.0;
  double devices = 0.0;
  double magnetic = 0.0;  ///< change of (1/2) L_s sum i^2
  double air_gap = 0.0;   ///< integral T_e w dt
  double friction = 0.0;
  double load = 0.0;
  double kinetic = 0.0;  ///< change of (1/2) J w^2
  double moved = 0.0;    ///< sum of |U_s i_dc|, |T_e w| and |T_load w|, integrated per segment: what the
                         ///< residuals are relative to
  double electrical_residual = 0.0;
  double mechanical_residual = 0.0;
};

struct Laws {
  double current_sum_A = 0.0;  ///< worst |i_a + i_b + i_c| at a segment's ends
  double reverse_diode_A =
      0.0;  ///< worst current of the wrong sign in a conducting diode, at a segment's ends
  double floating_current_A = 0.0;  ///< worst current in a floating leg
};

template <class Real>
class Audit {
 public:
  void segment(const Plant<Real>& plant, Real s);
  EnergyBook energy() const;
  const Laws& laws() const { return laws_; }

 private:
  void check_laws(const Plant<Real>& plant, Real s);
  Real magnetic_energy(const Plant<Real>& plant, Real s) const;
  Real kinetic_energy(const Plant<Real>& plant, Real s) const;

  bool begun_ = false;
  Real noise_ = 0;  ///< energy of a current and a speed at their noise: less than that cannot be balanced
  Real magnetic_start_ = 0, kinetic_start_ = 0, magnetic_end_ = 0, kinetic_end_ = 0;
  Real supplied_ = 0, copper_ = 0, devices_ = 0, air_gap_ = 0, friction_ = 0, load_ = 0, moved_ = 0;
  Real supplied_low_ = 0, copper_low_ = 0, devices_low_ = 0, air_gap_low_ = 0, friction_low_ = 0,
       load_low_ = 0;
  Laws laws_;
};

template <class Real>
Real Audit<Real>::magnetic_energy(const Plant<Real>& p, Real s) const {
  const Expansion<Real>& y = p.expansion();
  Real sum = 0;
  for (int k = 0; k < 3; ++k) {
    const Real i = series::evaluate(y.i[k], y.degree, s);
    sum += i * i;
  }
  return sum / (2 * p.constants().inv_L);
}

template <class Real>
Real Audit<Real>::kinetic_energy(const Plant<Real>& p, Real s) const {
  const Real w = series::evaluate(p.expansion().w, p.expansion().degree, s);
  return w * w / (2 * p.constants().inv_J);
}

template <class Real>
void Audit<Real>::check_laws(const Plant<Real>& plant, Real s) {
  const Expansion<Real>& y = plant.expansion();
  for (const Real at : {Real(0), s}) {
    PerLeg<Real> i;
    for (int k = 0; k < 3; ++k) i[k] = series::evaluate(y.i[k], y.degree, at);
    laws_.current_sum_A = std::max(laws_.current_sum_A, static_cast<double>(detail::abs(i[0] + i[1] + i[2])));
    for (int k = 0; k < 3; ++k) {
      const Connection leg = plant.mode().legs[k];
      const Real wrong = leg == Connection::low_diode    ? -i[k]
                         : leg == Connection::high_diode ? i[k]
                                                         : Real(0);
      laws_.reverse_diode_A = std::max(laws_.reverse_diode_A, static_cast<double>(wrong));
      if (is_floating(leg))
        laws_.floating_current_A = std::max(laws_.floating_current_A, static_cast<double>(detail::abs(i[k])));
    }
  }
}

template <class Real>
void Audit<Real>::segment(const Plant<Real>& plant, Real s) {
  using series::add_compensated, series::product_integral, series::integral;
  const Expansion<Real>& y = plant.expansion();
  const Constants<Real>& c = plant.constants();
  if (!begun_) {
    begun_ = true;
    magnetic_start_ = magnetic_energy(plant, Real(0));
    kinetic_start_ = kinetic_energy(plant, Real(0));
    const Real amp = noise_of(c.amp_scale, Real(1)), speed = noise_of(c.speed_scale, Real(1));
    noise_ = amp * amp / c.inv_L + speed * speed / c.inv_J;
  }
  check_laws(plant, s);
  const int n = y.degree;
  series::Coefficients<Real> dc{};
  Real copper = 0, devices = 0;
  for (int k = 0; k < 3; ++k) {
    const Connection leg = plant.mode().legs[k];
    if (is_floating(leg)) continue;
    const Real square = product_integral(y.i[k], y.i[k], n, s);
    copper += c.R * square;
    devices += pole_terms<Real>(leg, c.devices).r_ohm * square;
    if (is_diode(leg)) {
      const Real charge = integral(y.i[k], n, s);
      devices += Real(c.devices.V_f_V) * (leg == Connection::low_diode ? charge : -charge);
    }
    if (is_high(leg))
      for (int j = 0; j <= n; ++j) dc[j] += y.i[k][j];
  }
  const Real supplied = y.h * product_integral(y.bus, dc, n, s);
  const Real air_gap = y.h * product_integral(y.torque, y.w, n, s);
  const Real travel = y.h * integral(y.w, n, s);
  const Real slide = plant.mode().motion == Motion::forward    ? c.coulomb
                     : plant.mode().motion == Motion::backward ? -c.coulomb
                                                               : Real(0);
  add_compensated(supplied_, supplied_low_, supplied);
  add_compensated(copper_, copper_low_, y.h * copper);
  add_compensated(devices_, devices_low_, y.h * devices);
  add_compensated(air_gap_, air_gap_low_, air_gap);
  add_compensated(friction_, friction_low_, y.h * c.B * product_integral(y.w, y.w, n, s) + slide * travel);
  const Real load = c.load * travel;
  add_compensated(load_, load_low_, load);
  moved_ += detail::abs(supplied) + detail::abs(air_gap) + detail::abs(load);
  magnetic_end_ = magnetic_energy(plant, s);
  kinetic_end_ = kinetic_energy(plant, s);
}

template <class Real>
EnergyBook Audit<Real>::energy() const {
  const Real magnetic = magnetic_end_ - magnetic_start_, kinetic = kinetic_end_ - kinetic_start_;
  // A motor that coasts moves no energy through bridge or load; what it stored is then the yardstick.
  const Real scale = std::max(
      {moved_, magnetic_start_ + kinetic_start_, magnetic_end_ + kinetic_end_, noise_, Real(1e-300)});
  const auto d = [](Real v) { return static_cast<double>(v); };
  return {.supplied = d(supplied_),
          .copper = d(copper_),
          .devices = d(devices_),
          .magnetic = d(magnetic),
          .air_gap = d(air_gap_),
          .friction = d(friction_),
          .load = d(load_),
          .kinetic = d(kinetic),
          .moved = d(moved_),
          .electrical_residual = d((supplied_ - copper_ - devices_ - air_gap_ - magnetic) / scale),
          .mechanical_residual = d((air_gap_ - friction_ - load_ - kinetic) / scale)};
}

}  // namespace sixstep::plant

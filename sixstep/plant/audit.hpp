// SPDX-License-Identifier: Apache-2.0
// The audit holds a run to the laws of every run (model.md 5): energy balances, currents sum to zero, no
// diode conducts backwards. It integrates the segments' own polynomials, so its residuals are rounding.
#pragma once
#include "sixstep/plant/segment_energy.hpp"

namespace sixstep::plant {

/// Energy over a run, J. The residuals are what does not close, relative to the energy that moved.
struct EnergyBook {
  double supplied = 0.0;  ///< integral U_s i_dc dt, into the bridge
  double copper = 0.0;
  double devices = 0.0;
  double magnetic = 0.0;  ///< change of (1/2) L_s sum i^2
  double air_gap = 0.0;   ///< integral T_e w dt
  double friction = 0.0;
  double iron =
      0.0;  ///< what of friction is the motor's iron, where somebody tells it apart (study/measure/iron_gauge.hpp)
  double load = 0.0;
  double kinetic = 0.0;  ///< change of (1/2) J w^2
  double moved = 0.0;    ///< sum of |U_s i_dc|, |T_e w| and |T_load w|, integrated per segment
  double scale = 0.0;    ///< what moved, or what was stored where that is more: the residuals' unit
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
  /// What the balance needs of an instant: the stored energies are made of it once, at the end.
  struct Point {
    PerLeg<Real> i{};
    Real w = 0;
  };
  static Point end_of(const Expansion<Real>& y, Real s);
  void begin(const Plant<Real>& plant);
  void check_laws(const Mode& mode, const PerLeg<Real>& i);
  Real magnetic_energy(const Point& p) const {
    return (p.i[0] * p.i[0] + p.i[1] * p.i[1] + p.i[2] * p.i[2]) / (2 * inv_L_);
  }
  Real kinetic_energy(const Point& p) const { return p.w * p.w / (2 * inv_J_); }

  bool begun_ = false;
  Real inv_L_ = 1, inv_J_ = 1;
  Real noise_ = 0;  ///< energy of a current and a speed at their noise: less than that cannot be balanced
  Point start_, end_;
  series::CompensatedSum<Real> supplied_, copper_, devices_, air_gap_, friction_, load_;
  Real moved_ = 0;
  Laws laws_;
};

template <class Real>
void Audit<Real>::begin(const Plant<Real>& plant) {
  const Constants<Real>& c = plant.constants();
  const Expansion<Real>& y = plant.expansion();
  begun_ = true;
  inv_L_ = c.inv_L;
  inv_J_ = c.inv_J;
  start_ = {{y.i[0][0], y.i[1][0], y.i[2][0]}, y.w[0]};
  const Real amp = c.amp_noise, speed = c.speed_noise;
  noise_ = amp * amp / c.inv_L + speed * speed / c.inv_J;
}

/// All four series in one pass: their sums do not wait for each other.
template <class Real>
typename Audit<Real>::Point Audit<Real>::end_of(const Expansion<Real>& y, Real s) {
  Real a = 0, b = 0, c = 0, w = 0;
  for (int j = y.degree; j >= 1; --j) {
    a = (a + y.i[0][j]) * s;
    b = (b + y.i[1][j]) * s;
    c = (c + y.i[2][j]) * s;
    w = (w + y.w[j]) * s;
  }
  return {{y.i[0][0] + a, y.i[1][0] + b, y.i[2][0] + c}, y.w[0] + w};
}

template <class Real>
void Audit<Real>::check_laws(const Mode& mode, const PerLeg<Real>& i) {
  const auto raise = [](double& worst, Real v) { worst = std::max(worst, static_cast<double>(v)); };
  raise(laws_.current_sum_A, detail::abs(i[0] + i[1] + i[2]));
  for (int k = 0; k < 3; ++k) {
    const Connection leg = mode.legs[k];
    // mutant: -along_diode(leg, i[k]) => Real(0)
    if (is_diode(leg)) raise(laws_.reverse_diode_A, -along_diode(leg, i[k]));
    if (is_floating(leg)) raise(laws_.floating_current_A, detail::abs(i[k]));
  }
}

template <class Real>
void Audit<Real>::segment(const Plant<Real>& plant, Real s) {
  const Expansion<Real>& y = plant.expansion();
  const Constants<Real>& c = plant.constants();
  if (!begun_) begin(plant);
  // A shaft that was clamped while it turned has left its kinetic energy in the clamp, also where that let it
  // go at the same instant. What standstill snaps to zero is noise.
  const bool stopped = y.w[0] == 0 && (c.locked || detail::abs(end_.w) > c.speed_noise);
  // mutant: stopped && end_.w != 0 => false
  if (stopped && end_.w != 0) friction_.add(kinetic_energy(end_));
  end_ = end_of(y, s);
  check_laws(plant.mode(), {y.i[0][0], y.i[1][0], y.i[2][0]});
  check_laws(plant.mode(), end_.i);
  const SegmentEnergy<Real> e = segment_energy(plant, s);
  supplied_.add(e.supplied);
  copper_.add(e.copper);
  devices_.add(e.devices);
  air_gap_.add(e.air_gap);
  friction_.add(e.viscous + e.dry);
  load_.add(e.load);
  moved_ += detail::abs(e.supplied) + detail::abs(e.air_gap) + detail::abs(e.load);
}

template <class Real>
EnergyBook Audit<Real>::energy() const {
  const Real magnetic_start = magnetic_energy(start_), magnetic_end = magnetic_energy(end_);
  const Real kinetic_start = kinetic_energy(start_), kinetic_end = kinetic_energy(end_);
  const Real magnetic = magnetic_end - magnetic_start, kinetic = kinetic_end - kinetic_start;
  // A motor that coasts moves no energy through bridge or load; what it stored is then the yardstick.
  const Real scale =
      std::max({moved_, magnetic_start + kinetic_start, magnetic_end + kinetic_end, noise_, Real(1e-300)});
  const auto d = [](Real v) { return static_cast<double>(v); };
  return {.supplied = d(supplied_.value),
          .copper = d(copper_.value),
          .devices = d(devices_.value),
          .magnetic = d(magnetic),
          .air_gap = d(air_gap_.value),
          .friction = d(friction_.value),
          .load = d(load_.value),
          .kinetic = d(kinetic),
          .moved = d(moved_),
          .scale = d(scale),
          .electrical_residual =
              d((supplied_.value - copper_.value - devices_.value - air_gap_.value - magnetic) / scale),
          .mechanical_residual = d((air_gap_.value - friction_.value - load_.value - kinetic) / scale)};
}

}  // namespace sixstep::plant

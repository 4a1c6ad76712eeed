// SPDX-License-Identifier: Apache-2.0
// Checks the laws of every run (model.md 5) for the general plant. The balances of plant/audit.hpp are
// extended by the energies that only the general kernel models.
#pragma once
#include "sixstep/plant/audit.hpp"
#include "sixstep/plant/general/segment_energy.hpp"

namespace sixstep::plant::general {

template <class Real>
class Audit {
 public:
  void segment(const Plant<Real>& plant, Real s);
  EnergyBook energy() const;
  double copper_J() const { return static_cast<double>(copper_.value); }
  const Laws& laws() const { return laws_; }

 private:
  struct Stored {
    Real field = 0, moving = 0;
  };
  static Stored stored(const Plant<Real>& plant, Real s) {
    return {field_energy(plant, s), moving_energy(plant, s)};
  }
  void check_laws(const Plant<Real>& plant, Real s);

  bool begun_ = false;
  Real noise_ = 0, moved_ = 0;
  Stored start_, end_;
  Real end_w_ = 0;
  series::CompensatedSum<Real> supplied_, copper_, devices_, air_gap_, friction_, load_, cogging_, brake_;
  Laws laws_;
};

template <class Real>
void Audit<Real>::check_laws(const Plant<Real>& plant, Real s) {
  const auto raise = [](double& worst, Real v) { worst = std::max(worst, static_cast<double>(v)); };
  const auto& y = plant.expansion();
  Real sum = 0;
  for (int k = 0; k < 3; ++k) {
    const Real i = series::evaluate(y.i[k], y.degree, s);
    const Connection leg = plant.mode().legs[k];
    sum += i;
    if (const int direction = direction_of(plant.constants().devices, leg); direction != 0)
      raise(laws_.reverse_diode_A, -Real(direction) * i);
    if (is_floating(leg)) raise(laws_.floating_current_A, plant::detail::abs(i));
  }
  raise(laws_.current_sum_A, plant::detail::abs(sum));
}

template <class Real>
void Audit<Real>::segment(const Plant<Real>& plant, Real s) {
  const auto& c = plant.constants();
  const Stored begins = stored(plant, Real(0));
  if (!begun_) {
    begun_ = true;
    start_ = end_ = begins;
    noise_ = c.amp_noise * c.amp_noise / c.inv_L + c.speed_noise * c.speed_noise / c.inv_J;
  }
  // A clamp that closes on a turning shaft absorbs the shaft's kinetic energy, even if the clamp opens at the
  // same instant.
  const auto& y = plant.expansion();
  const bool stopped = c.locked || (y.w[0] == 0 && plant::detail::abs(end_w_) > c.speed_noise);
  if (stopped && end_.moving > begins.moving) friction_.add(end_.moving - begins.moving);
  end_ = stored(plant, s);
  end_w_ = series::evaluate(y.w, y.degree, s);
  check_laws(plant, Real(0));
  check_laws(plant, s);
  const SegmentEnergy<Real> e = segment_energy(plant, s);
  supplied_.add(e.supplied);
  copper_.add(e.copper);
  devices_.add(e.devices);
  air_gap_.add(e.air_gap);
  friction_.add(e.viscous + e.dry);
  load_.add(e.load);
  brake_.add(brake_energy(plant, s));
  const Real cogging = cogging_energy(plant, s);
  cogging_.add(cogging);
  moved_ += plant::detail::abs(e.supplied) + plant::detail::abs(e.air_gap) + plant::detail::abs(e.load) +
            plant::detail::abs(cogging);
}

template <class Real>
EnergyBook Audit<Real>::energy() const {
  const Real magnetic = end_.field - start_.field, kinetic = end_.moving - start_.moving - cogging_.value;
  const Real scale =
      std::max({moved_, start_.field + start_.moving, end_.field + end_.moving, noise_, Real(1e-300)});
  const auto d = [](Real v) { return static_cast<double>(v); };
  return {.supplied = d(supplied_.value),
          .copper = d(copper_.value),
          .devices = d(devices_.value),
          .magnetic = d(magnetic),
          .air_gap = d(air_gap_.value),
          .friction = d(friction_.value),
          .load = d(load_.value),
          .kinetic = d(kinetic),
          .brake_resistor = d(brake_.value),
          .moved = d(moved_),
          .scale = d(scale),
          .electrical_residual =
              d((supplied_.value - copper_.value - devices_.value - air_gap_.value - magnetic) / scale),
          .mechanical_residual = d((air_gap_.value - friction_.value - load_.value - kinetic) / scale)};
}

}  // namespace sixstep::plant::general

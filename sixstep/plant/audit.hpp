// SPDX-License-Identifier: Apache-2.0
// Checks the laws that every run obeys (model.md 5):
// - the energy balances are exact,
// - the sum of the phase currents is zero,
// - no diode conducts backwards.
// The audit integrates the polynomials of the segments, so that its residuals are only rounding errors.
#pragma once
#include <algorithm>

#include "sixstep/plant/segment_energy.hpp"

namespace sixstep::plant {

/// Energies over a run, J. A residual is the error of an energy balance divided by `scale`.
struct EnergyBook {
  double supplied = 0.0;  ///< integral U_s i_dc dt, from the bus into the bridge
  double copper = 0.0;
  double devices = 0.0;
  double magnetic = 0.0;  ///< change of (1/2) L_s (i_a^2 + i_b^2 + i_c^2)
  double air_gap = 0.0;   ///< integral T_e w dt
  double friction = 0.0;
  double iron = 0.0;  ///< iron losses, a part of `friction`; only study/measure/iron_gauge.hpp computes this
                      ///< member
  double load = 0.0;
  double kinetic = 0.0;  ///< change of (1/2) J w^2
  double brake_resistor =
      0.0;  ///< heat of the brake resistor at the bus; not part of the balances, because these begin at the
            ///< bridge
  double moved = 0.0;  ///< sum of |U_s i_dc|, |T_e w|, |T_load w| and |T_cogging w|, integrated per segment
  double scale = 0.0;  ///< the larger of `moved` and the stored energy; the residuals are relative to it
  double electrical_residual = 0.0;
  double mechanical_residual = 0.0;
};

struct Laws {
  double current_sum_A = 0.0;  ///< largest |i_a + i_b + i_c| at a segment's ends
  double reverse_diode_A =
      0.0;  ///< largest current of the wrong sign in a conducting diode, at a segment's ends
  double floating_current_A = 0.0;  ///< largest current in a floating leg
};

template <class Real>
class Audit {
 public:
  void segment(const Plant<Real>& plant, Real s) { take(plant, segment_energy(plant, s)); }
  /// Adds a segment whose energies are already computed.
  [[gnu::always_inline]] void take(const Plant<Real>& plant, const SegmentEnergy<Real>& e);
  EnergyBook energy() const;
  double copper_J() const { return static_cast<double>(supplied_copper_.value[1]); }
  const Laws& laws() const { return laws_; }

 private:
  /// Currents, A, in the order of the legs' law, and speed, rad/s, at an instant. energy() computes the
  /// stored energies from the first and the last Point.
  struct Point {
    PerLeg<Real> i{};
    Real w = 0;
  };
  using Pair = series::Pair<Real>;
  /// Two sums that are computed in parallel, each with its rounding error.
  struct TwoSums {
    Pair value{}, low{};
    void add(Real first, Real second) { series::add_compensated(value, low, Pair{first, second}); }
  };
  [[gnu::always_inline]] static Point begin_of(const Expansion<Real>& y, const LegsLaw<Real>& law);
  [[gnu::always_inline]] static Point end_of(const Expansion<Real>& y, const LegsLaw<Real>& law,
                                             const Point& begin);
  [[gnu::always_inline]] void begin(const Plant<Real>& plant);
  [[gnu::always_inline]] void check_laws(const LegsLaw<Real>& law, const Point& begin, const Point& end);
  [[gnu::always_inline]] Real magnetic_energy(const Point& p) const {
    return (p.i[0] * p.i[0] + p.i[1] * p.i[1] + p.i[2] * p.i[2]) / (2 * inv_L_);
  }
  [[gnu::always_inline]] Real kinetic_energy(const Point& p) const { return p.w * p.w / (2 * inv_J_); }

  bool begun_ = false;
  Real inv_L_ = 1, inv_J_ = 1;
  Real noise_ = 0;  ///< J; energy of a current and a speed at noise level: the least meaningful scale of a
                    ///< balance
  Point start_, end_;
  TwoSums supplied_copper_, devices_air_gap_, friction_load_;
  Real moved_ = 0;
  Laws laws_;
};

template <class Real>
inline void Audit<Real>::begin(const Plant<Real>& plant) {
  const Constants<Real>& c = plant.constants();
  const Expansion<Real>& y = plant.expansion();
  begun_ = true;
  inv_L_ = c.inv_L;
  inv_J_ = c.inv_J;
  start_ = {{y.i[0][0], y.i[1][0], y.i[2][0]}, y.w[0]};  // legs a, b, c: the stored energy does not depend on
                                                         // the order
  const Real amp = c.amp_noise, speed = c.speed_noise;
  noise_ = amp * amp / c.inv_L + speed * speed / c.inv_J;
}

template <class Real>
inline typename Audit<Real>::Point Audit<Real>::begin_of(const Expansion<Real>& y, const LegsLaw<Real>& law) {
  return {{y.i[law.leg[0]][0], y.i[law.leg[1]][0], y.i[law.leg[2]][0]}, y.w[0]};
}

/// `y.end` contains the increments up to the segment's end; Plant::advance() continues the state from them.
template <class Real>
inline typename Audit<Real>::Point Audit<Real>::end_of(const Expansion<Real>& y, const LegsLaw<Real>& law,
                                                       const Point& begin) {
  const Real w = begin.w + y.end.w;
  if (law.connected < 2) return {begin.i, w};
  const Real first = begin.i[0] + y.end.i;
  if (law.connected == 2) return {{first, -first, begin.i[2]}, w};
  const Real second = begin.i[1] + y.end.i_2;
  return {{first, second, -(first + second)}, w};
}

template <class Real>
inline void Audit<Real>::check_laws(const LegsLaw<Real>& law, const Point& begin, const Point& end) {
  const auto raise = [](double& worst, Real v) { worst = std::max(worst, static_cast<double>(v)); };
  const auto sum = [](const Point& p) { return detail::abs(p.i[0] + p.i[1] + p.i[2]); };
  raise(laws_.current_sum_A, std::max(sum(begin), sum(end)));
  // `begin.i` is in the order of the legs' law: a floating leg comes last. Its current does not change within
  // a segment.
  if (law.connected < 3) raise(laws_.floating_current_A, detail::abs(begin.i[2]));
  if (law.connected < 2)
    raise(laws_.floating_current_A, std::max(detail::abs(begin.i[0]), detail::abs(begin.i[1])));
  if (law.diodes == 0) return;
  for (int n = 0; n < 3; ++n)
    // mutant: -std::min(law.along[n] * begin.i[n], law.along[n] * end.i[n]) => Real(0)
    raise(laws_.reverse_diode_A, -std::min(law.along[n] * begin.i[n], law.along[n] * end.i[n]));
}

template <class Real>
inline void Audit<Real>::take(const Plant<Real>& plant, const SegmentEnergy<Real>& e) {
  const Expansion<Real>& y = plant.expansion();
  const Constants<Real>& c = plant.constants();
  if (!begun_) begin(plant);
  // A clamp that closes on a turning shaft absorbs the shaft's kinetic energy, even if the clamp opens at the
  // same instant. Standstill also sets a speed within noise to zero; the kinetic energy of such a speed is
  // not counted.
  const bool stopped = y.w[0] == 0 && (c.locked || detail::abs(end_.w) > c.speed_noise);
  // mutant: stopped && end_.w != 0 => false
  if (stopped && end_.w != 0) friction_load_.add(kinetic_energy(end_), Real(0));
  const LegsLaw<Real>& law = c.legs[legs_index(plant.mode().legs)];
  const Point begin = begin_of(y, law);
  end_ = end_of(y, law, begin);
  check_laws(law, begin, end_);
  supplied_copper_.add(e.supplied, e.copper);
  devices_air_gap_.add(e.devices, e.air_gap);
  friction_load_.add(e.viscous + e.dry, e.load);
  moved_ += detail::abs(e.supplied) + detail::abs(e.air_gap) + detail::abs(e.load);
}

template <class Real>
EnergyBook Audit<Real>::energy() const {
  const Real magnetic_start = magnetic_energy(start_), magnetic_end = magnetic_energy(end_);
  const Real kinetic_start = kinetic_energy(start_), kinetic_end = kinetic_energy(end_);
  const Real magnetic = magnetic_end - magnetic_start, kinetic = kinetic_end - kinetic_start;
  // A coasting motor transfers no energy to bridge or load. The scale is then the stored energy.
  const Real scale =
      std::max({moved_, magnetic_start + kinetic_start, magnetic_end + kinetic_end, noise_, Real(1e-300)});
  const Real supplied = supplied_copper_.value[0], copper = supplied_copper_.value[1];
  const Real devices = devices_air_gap_.value[0], air_gap = devices_air_gap_.value[1];
  const Real friction = friction_load_.value[0], load = friction_load_.value[1];
  const auto d = [](Real v) { return static_cast<double>(v); };
  return {.supplied = d(supplied),
          .copper = d(copper),
          .devices = d(devices),
          .magnetic = d(magnetic),
          .air_gap = d(air_gap),
          .friction = d(friction),
          .load = d(load),
          .kinetic = d(kinetic),
          .moved = d(moved_),
          .scale = d(scale),
          .electrical_residual = d((supplied - copper - devices - air_gap - magnetic) / scale),
          .mechanical_residual = d((air_gap - friction - load - kinetic) / scale)};
}

// AVX version of segment(), compiled once in plant/audit_avx.cpp with the energies inlined, because this
// function runs once per segment. Other processors use the shared function segment_energy().
template <>
void Audit<double>::segment(const Plant<double>& plant, double s);
#ifdef __x86_64__
namespace detail {
void audit_with_avx(Audit<double>& audit, const Plant<double>& plant, double s);
}
#endif

}  // namespace sixstep::plant

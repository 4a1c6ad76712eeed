// SPDX-License-Identifier: Apache-2.0
// Integrates currents, torque and energies over part of a run, exactly on the segments' polynomials, and
// finds their extremes. The mean values, ripple and energy balance of an operating point are computed from
// the results.
#pragma once
#include <algorithm>
#include <cmath>
#include <limits>

#include "sixstep/plant/segment_energy.hpp"
#include "sixstep/series/extremes.hpp"
#include "sixstep/study/measure/signals.hpp"

namespace sixstep::analysis {

/// Integrals of the named quantities over time, in SI units: `torque` is the integral of T_e in N m s.
/// Energies are in J.
struct Sums {
  double seconds = 0.0;
  double supplied = 0.0, copper = 0.0, devices = 0.0, air_gap = 0.0, magnetic = 0.0;
  double torque = 0.0, torque_square = 0.0;
  double motor = 0.0, motor_size = 0.0, motor_square = 0.0;  ///< integrals of i_m, |i_m|, i_m^2
  double winding = 0.0;                                      ///< integral of (|i_a| + |i_b| + |i_c|)/2
  double current_peak = 0.0;                                 ///< greatest |i| of any phase, A
  double torque_low = std::numeric_limits<double>::infinity(), torque_high = -torque_low;
  double motor_low = torque_low, motor_high = -torque_low;

  void add(const Sums& more) {
    for (double Sums::*sum : {&Sums::seconds, &Sums::supplied, &Sums::copper, &Sums::devices, &Sums::air_gap,
                              &Sums::magnetic, &Sums::torque, &Sums::torque_square, &Sums::motor,
                              &Sums::motor_size, &Sums::motor_square, &Sums::winding})
      this->*sum += more.*sum;
    current_peak = std::max(current_peak, more.current_peak);
    torque_low = std::min(torque_low, more.torque_low);
    torque_high = std::max(torque_high, more.torque_high);
    motor_low = std::min(motor_low, more.motor_low);
    motor_high = std::max(motor_high, more.motor_high);
  }
};

/// An observer of sim::run for any System that has a plant().
class SumsRecorder {
 public:
  const Sums& sums() const { return sums_; }

  template <class System>
  void segment(const System& system, double s) {
    const auto& plant = system.plant();
    const plant::Expansion<double>& y = plant.expansion();
    const double dt = y.h * s;
    sums_.seconds += dt;
    if (plant::connected_count(plant.mode().legs) < 2) return no_current();
    const plant::SegmentEnergy<double> e = plant::segment_energy(plant, s);
    sums_.supplied += e.supplied;
    sums_.copper += e.copper;
    sums_.devices += e.devices;
    sums_.air_gap += e.air_gap;
    sums_.magnetic += stored(plant, s) - stored(plant, 0.0);
    const Integrals torque = integrals(y.torque, y.degree, s);
    sums_.torque += dt * torque.mean;
    sums_.torque_square += dt * torque.square;
    widen(y.torque, y.degree, s, sums_.torque_low, sums_.torque_high);
    motor(plant, y, s);
    for (int k = 0; k < 3; ++k) {
      if (plant::is_floating(plant.mode().legs[k])) continue;
      double low = -sums_.current_peak, high = sums_.current_peak;
      widen(y.i[k], y.degree, s, low, high);
      sums_.current_peak = std::max(-low, high);
      const double mean = integrals(y.i[k], y.degree, s).mean;
      sums_.winding += dt / 2 * size(y.i[k], y.degree, s, mean);
    }
  }

 private:
  struct Integrals {
    double mean, square;
  };
  static Integrals integrals(const study::Series& c, int degree, double s) {
    Integrals out{};
    series::with_points_for(degree, [&]<int points>() {
      const auto v = series::values_at<points>(c, degree, series::nodes_up_to<points>(s));
      out = {series::weighted_sum<points>(v), series::weighted_sum<points>(v, v)};
    });
    return out;
  }

  /// Magnetic energy (1/2) L_s sum i^2 at the fraction s of the segment, J.
  template <class Plant>
  static double stored(const Plant& plant, double s) {
    const plant::Expansion<double>& y = plant.expansion();
    double squares = 0.0;
    for (int k = 0; k < 3; ++k) {
      const double i = series::evaluate(y.i[k], y.degree, s);
      squares += i * i;
    }
    return squares / (2 * plant.constants().inv_L);
  }

  /// Widens [low, high] to the values of the polynomial `c` over [0, s]. A bound first excludes the segments
  /// that cannot widen it.
  static void widen(const study::Series& c, int degree, double s, double& low, double& high) {
    const double reach = series::magnitude_of(c, degree) - std::fabs(c[0]);
    if (low <= c[0] - reach && c[0] + reach <= high) return;
    const series::Extremes<double> e = series::extremes(series::restricted(c, degree, 0.0, s), degree);
    low = std::min(low, e.low);
    high = std::max(high, e.high);
  }

  template <class Plant>
  void motor(const Plant& plant, const plant::Expansion<double>& y, double s) {
    const plant::PerLeg<double> weight = study::motor_current_weights(plant.sector());
    study::Series c{};
    for (int j = 0; j <= y.degree; ++j)
      c[j] = weight[0] * y.i[0][j] + weight[1] * y.i[1][j] + weight[2] * y.i[2][j];
    const double dt = y.h * s;
    const Integrals i = integrals(c, y.degree, s);
    sums_.motor += dt * i.mean;
    sums_.motor_square += dt * i.square;
    sums_.motor_size += dt * size(c, y.degree, s, i.mean);
    widen(c, y.degree, s, sums_.motor_low, sums_.motor_high);
  }

  /// Mean of the polynomial's magnitude over [0, s], summed between its sign changes.
  static double size(const study::Series& c, int degree, double s, double mean) {
    const double scale = series::magnitude_of(c, degree);
    if (2 * std::fabs(c[0]) > scale) return std::fabs(mean);
    const study::Series all = series::restricted(c, degree, 0.0, s);
    double sum = 0.0, from = 0.0;
    const auto part = [&](double to) {
      sum +=
          (to - from) * std::fabs(series::whole_integral(series::restricted(all, degree, from, to), degree));
      from = to;
    };
    series::for_each_sign_change(all, degree, scale, part);
    part(1.0);
    return sum;
  }

  void no_current() {
    sums_.torque_low = std::min(sums_.torque_low, 0.0);
    sums_.torque_high = std::max(sums_.torque_high, 0.0);
    sums_.motor_low = std::min(sums_.motor_low, 0.0);
    sums_.motor_high = std::max(sums_.motor_high, 0.0);
  }

  Sums sums_;
};

}  // namespace sixstep::analysis

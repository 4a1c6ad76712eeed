// SPDX-License-Identifier: Apache-2.0
// A signal over one segment as a polynomial: what the figures of merit integrate and search.
#pragma once
#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "sixstep/rig/rig.hpp"
#include "sixstep/series/extremes.hpp"
#include "sixstep/study/scenario.hpp"

namespace sixstep::study {

using Series = series::Coefficients<double>;

/// Unit of a signal, as shown behind a figure.
constexpr const char* unit_of(Signal signal) {
  switch (signal) {
    case Signal::speed:
      return "rad/s";
    case Signal::position:
      return "deg";
    case Signal::torque:
      return "N m";
    case Signal::bus_voltage:
      return "V";
    default:
      return "A";
  }
}

/// Motor current i_m = (i_p - i_n)/2 of the positive pair of a sector (MODEL 3), as weights of i_a, i_b, i_c.
inline plant::PerLeg<double> motor_current_weights(int sector) {
  const control::Pair pair = control::positive_pair(static_cast<std::uint8_t>(sector));
  plant::PerLeg<double> w{};
  w[static_cast<std::size_t>(pair.source)] = 0.5;
  w[static_cast<std::size_t>(pair.sink)] = -0.5;
  return w;
}

/// [from, to] cut at every sign change of a phase current.
template <class Expansion>
std::vector<double> magnitude_cuts(const Expansion& y, double from, double to) {
  std::vector<double> cuts = {from, to};
  for (int k = 0; k < 3; ++k) {
    const Series i = series::restricted(y.i[k], y.degree, from, to);
    series::for_each_sign_change(i, y.degree, series::magnitude_of(i, y.degree),
                                 [&](double s) { cuts.push_back(from + s * (to - from)); });
  }
  std::sort(cuts.begin(), cuts.end());
  return cuts;
}

/// The bus current as weights of i_a, i_b, i_c.
template <class Plant>
plant::PerLeg<double> bus_current_weights(const Plant& plant) {
  plant::PerLeg<double> w{};
  for (int k = 0; k < 3; ++k) w[k] = plant::is_high(plant.mode().legs[k]) ? 1.0 : 0.0;
  return w;
}

/// Half the sum of the current magnitudes has kinks where a phase changes sign; within a part of a segment in
/// which none does, `sign` makes it a polynomial. All other signals ignore `sign`.
template <class Rig>
Series signal_series(const Rig& rig, Signal signal, const plant::PerLeg<double>& sign) {
  const auto& y = rig.plant().expansion();
  const auto combined = [&](const plant::PerLeg<double>& w) {
    Series c{};
    for (int j = 0; j <= y.degree; ++j) c[j] = w[0] * y.i[0][j] + w[1] * y.i[1][j] + w[2] * y.i[2][j];
    return c;
  };
  switch (signal) {
    case Signal::current:
      return combined(motor_current_weights(rig.plant().sector()));
    case Signal::phase_a:
      return y.i[0];
    case Signal::phase_b:
      return y.i[1];
    case Signal::phase_c:
      return y.i[2];
    case Signal::current_magnitude:
      return combined({sign[0] / 2, sign[1] / 2, sign[2] / 2});
    case Signal::speed:
      return y.w;
    case Signal::torque:
      return y.torque;
    case Signal::bus_voltage:
      return y.bus;
    case Signal::bus_current:
      return combined(bus_current_weights(rig.plant()));
    case Signal::position: {
      Series c = y.x;
      const double degrees = 180.0 / base::pi / rig.plant().constants().pole_pairs;
      for (int j = 0; j <= y.degree; ++j) c[j] *= degrees;
      c[0] += static_cast<double>(rig.plant().state().sector) * 60.0 / rig.plant().constants().pole_pairs;
      return c;
    }
  }
  return {};
}

/// Where a signal stays over the whole segment, from the bounds that the expansion comes with: wider than the
/// curve, and by more than rounding. Without limits where no bound is at hand.
template <class Rig>
series::Extremes<double> signal_bounds(const Rig& rig, Signal signal) {
  const auto& y = rig.plant().expansion();
  // Sums of up to 16 terms and of three series: rounding is below 32 * 2^-53 of their magnitudes.
  const auto around = [](double middle, double reach) {
    const double wide = reach + 0x1p-48 * (std::fabs(middle) + reach);
    return series::Extremes<double>{middle - wide, middle + wide};
  };
  const auto combined = [&](const plant::PerLeg<double>& w) {
    double middle = 0.0, reach = 0.0;
    for (int k = 0; k < 3; ++k) {
      middle += w[k] * y.i[k][0];
      reach += std::fabs(w[k]) * (y.reach_i[k] + 0x1p-48 * std::fabs(y.i[k][0]));
    }
    return around(middle, reach);
  };
  switch (signal) {
    case Signal::current:
      return combined(motor_current_weights(rig.plant().sector()));
    case Signal::phase_a:
      return combined({1.0, 0.0, 0.0});
    case Signal::phase_b:
      return combined({0.0, 1.0, 0.0});
    case Signal::phase_c:
      return combined({0.0, 0.0, 1.0});
    case Signal::bus_current:
      return combined(bus_current_weights(rig.plant()));
    case Signal::speed:
      return around(y.w[0], y.reach_w);
    default:
      return {-std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};
  }
}

}  // namespace sixstep::study

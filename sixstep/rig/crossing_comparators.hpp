// SPDX-License-Identifier: Apache-2.0
// Comparators that compare each filtered terminal voltage with a virtual star point or with half the bus
// (model.md 4). Between two events the filtered voltages are polynomials. A comparator's edge is therefore
// located like any event:
//
//   dx/dt = (u - x)/tau:   x_(n+1) = (h/tau) (u_n - x_n)/(n + 1),   h <= tau/2
//
// u is a terminal's voltage, x the filtered voltage, u_n and x_n the coefficients of their polynomials, tau
// the time constant of the filter, h the segment's length. The line of leg k rises where x_k - reference
// exceeds offset_k + hysteresis/2, and falls where it drops below offset_k - hysteresis/2.
#pragma once
#include <algorithm>

#include "sixstep/rig/front_end.hpp"

namespace sixstep::rig {

class Crossings {
 public:
  /// Sets the lines at the start of the run. A line whose voltage is exactly at its threshold is low.
  Crossings(const FrontEndConfig& config, const FrontEndReading& at) : config_(config) {
    for (std::size_t k = 0; k < 3; ++k) gain_[k] = 1.0 + config.divider_gain_error[k];
    for (std::size_t k = 0; k < 3; ++k)
      if (above(at, k) > 0) turn_over(k);
  }
  /// Breaks the divider of a leg: its voltage is 0 V from now on. Lines that contradict their thresholds then
  /// change.
  void break_divider(std::size_t leg, const FrontEndReading& at) {
    gain_[leg] = 0.0;
    const double half = config_.comparators.hysteresis_V / 2;
    for (std::size_t k = 0; k < 3; ++k)
      if ((lines_ & (4U >> k)) != 0 ? above(at, k) < -half : above(at, k) > half) turn_over(k);
  }

  bool fitted() const { return config_.has_comparators(); }
  /// Bound of a segment's length, s. In a longer segment, the error of the filter's series of 16 terms would
  /// exceed rounding.
  double longest_s() const { return config_.comparators.lag_s / 2; }
  /// Comparators' lines of legs a, b, c as bits 2, 1, 0, as in a Hall code.
  std::uint8_t lines() const { return lines_; }
  void turn_over(std::size_t leg) { lines_ ^= static_cast<std::uint8_t>(4U >> leg); }

  /// Calls visit(leg, series, degree, noise) for each line. A series falls through zero when its line
  /// changes. `of` must be expanded, and the plant must not have advanced over it yet.
  template <class Real, class Visit>
  void guards(const FrontEndSegment<Real>& of, const plant::TerminalSeries<Real>& u,
              const FrontEndReading& now, Real volt_scale, Visit&& visit) const {
    plant::TerminalSeries<Real> x;
    for (std::size_t k = 0; k < 3; ++k) {
      x[k] = lagged(of, u[of.phase[k]], now.comparator_V[k]);
      for (Real& c : x[k]) c = Real(gain_[k]) * c;
    }
    const Coefficients<Real> bus = lagged(of, of.y.bus, now.comparator_bus_V);
    const Real noise = plant::noise_of(volt_scale, Real(1));
    // After an edge, the voltage must differ from the threshold of the opposite edge by more than rounding
    // errors.
    const Real half = std::max(Real(config_.comparators.hysteresis_V) / 2, 4 * noise);
    for (std::size_t k = 0; k < 3; ++k) {
      const Real sign = (lines_ & (4U >> k)) != 0 ? Real(1) : Real(-1);
      Coefficients<Real> g;
      for (int n = 0; n <= series::max_degree; ++n)
        g[n] = sign * (x[k][n] - reference(plant::PerLeg<Real>{x[0][n], x[1][n], x[2][n]}, bus[n]));
      g[0] += half - sign * Real(config_.comparators.offset_V[k]);
      visit(k, g, series::max_degree, noise);
    }
  }

 private:
  /// Filtered voltage of a terminal minus its comparator's threshold without hysteresis, V.
  double above(const FrontEndReading& at, std::size_t leg) const {
    plant::PerLeg<double> x{};
    for (std::size_t k = 0; k < 3; ++k) x[k] = gain_[k] * at.comparator_V[k];
    return x[leg] - reference(x, at.comparator_bus_V) - config_.comparators.offset_V[leg];
  }
  template <class Real>
  using Coefficients = series::Coefficients<Real>;

  template <class Real>
  Real reference(const plant::PerLeg<Real>& x, Real bus) const {
    if (config_.comparators.against == CrossingReference::half_bus) return bus / 2;
    return (x[0] + x[1] + x[2]) / 3;
  }
  template <class Real>
  Coefficients<Real> lagged(const FrontEndSegment<Real>& of, const Coefficients<Real>& u, double from) const {
    const Real rate = of.y.h / Real(config_.comparators.lag_s);
    Coefficients<Real> x;
    x[0] = Real(from);
    for (int n = 0; n < series::max_degree; ++n) {
      const Real input = n <= of.y.degree ? u[n] : Real(0);
      x[n + 1] = rate * (input - x[n]) / Real(n + 1);
    }
    return x;
  }

  FrontEndConfig config_;
  plant::PerLeg<double> gain_{};
  std::uint8_t lines_ = 0;
};

/// Empty type for a firmware without comparators.
struct NoCrossings {};

}  // namespace sixstep::rig

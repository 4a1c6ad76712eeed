// SPDX-License-Identifier: Apache-2.0
// The analogue front end between circuit and converters (model.md 4): current amplifiers with a bandwidth and
// a delay, and dividers of bus and terminals with a capacitor. Each amplifier and each divider is a
// first-order lag. The lags are integrated exactly over every segment, so that a sample contains the effect
// of all earlier switching. For a board without lags, this file needs one branch per segment.
#pragma once
#include <limits>

#include "sixstep/plant/terminals.hpp"
#include "sixstep/rig/front_end_config.hpp"
#include "sixstep/series/first_order_lag.hpp"
#include "sixstep/sim/instant.hpp"

namespace sixstep::rig {

/// Inputs of the front end over one segment of length h, of which the fraction s in (0, 1] is used.
template <class Real>
struct FrontEndSegment {
  const plant::Expansion<Real>& y;
  plant::PerLeg<std::size_t> phase{0, 1, 2};  ///< phase of the motor that is connected to each leg
  plant::Legs legs{};                         ///< connections of the phases
  Real s = 1;
  sim::Instant from{}, to{}, next_sample{};
};

class FrontEnd {
 public:
  /// The initial state has settled to these voltages, V, without current.
  FrontEnd(const FrontEndConfig& config, double bus_V, const plant::PerLeg<double>& terminal_V)
      : config_(config),
        reading_{.terminal_V = terminal_V,
                 .bus_V = bus_V,
                 .comparator_V = terminal_V,
                 .comparator_bus_V = bus_V,
                 .currents = config.lags_currents(),
                 .voltages = config.lags_voltages()} {
    bus_.set(bus_V);
    comparator_bus_.set(bus_V);
    for (std::size_t k = 0; k < 3; ++k) {
      terminal_[k].set(terminal_V[k]);
      comparator_[k].set(terminal_V[k]);
    }
  }

  bool follows() const { return reading_.currents || follows_terminals(); }
  bool follows_terminals() const { return reading_.voltages || config_.has_comparators(); }
  const FrontEndReading& reading() const { return reading_; }

  template <class Real>
  void follow(const FrontEndSegment<Real>& of) {
    if (reading_.currents) follow_currents(of);
    if (reading_.voltages) {
      bus_.add(by(config_.divider_s, of, of.y.bus, bus_));
      reading_.bus_V = bus_.value;
    }
    if (config_.has_comparators()) {
      comparator_bus_.add(by(config_.comparators.lag_s, of, of.y.bus, comparator_bus_));
      reading_.comparator_bus_V = comparator_bus_.value;
    }
  }
  /// Integrates the series u of the terminals, in the order of the phases. Call it if the dividers lag or the
  /// board has comparators.
  template <class Real>
  void follow_terminals(const FrontEndSegment<Real>& of, const plant::TerminalSeries<Real>& u);

 private:
  using Kept = series::CompensatedSum<double>;

  /// Weights of a lag over the fraction s of the segment.
  template <class Real>
  static series::LagWeights weights(double lag_s, const FrontEndSegment<Real>& of, double s) {
    const double z =
        lag_s > 0 ? s * static_cast<double>(of.y.h) / lag_s : std::numeric_limits<double>::infinity();
    return series::lag_weights(z, of.y.degree);
  }
  template <class Real>
  static series::Coefficients<Real> dc_link(const FrontEndSegment<Real>& of) {
    series::Coefficients<Real> sum{};
    for (std::size_t k = 0; k < 3; ++k)
      if (plant::is_high(of.legs[k]))
        for (int n = 0; n <= of.y.degree; ++n) sum[n] += of.y.i[k][n];
    return sum;
  }
  template <class Real>
  static double by(double lag_s, const FrontEndSegment<Real>& of, const series::Coefficients<Real>& u,
                   const Kept& x) {
    const auto s = static_cast<double>(of.s);
    return series::lag_increment(u, of.y.degree, s, weights(lag_s, of, s), x.value);
  }
  template <class Real>
  void follow_currents(const FrontEndSegment<Real>& of);
  template <class Real>
  static void follow_legs(double lag_s, const FrontEndSegment<Real>& of, const plant::TerminalSeries<Real>& u,
                          plant::PerLeg<Kept>& kept, plant::PerLeg<double>& shown);

  FrontEndConfig config_;
  plant::PerLeg<Kept> i_{}, terminal_{}, comparator_{};
  Kept dc_link_{}, bus_{}, comparator_bus_{};
  FrontEndReading reading_{};
};

/// With a delay, the converters receive the amplifiers' outputs at one delay before the sample. If the
/// outputs jump at this instant, the converters receive the values before the jump.
template <class Real>
void FrontEnd::follow_currents(const FrontEndSegment<Real>& of) {
  static const series::Coefficients<Real> none{};
  const series::Coefficients<Real> link = dc_link(of);
  const int degree = of.y.degree;
  plant::PerLeg<const series::Coefficients<Real>*> leg{};
  for (std::size_t k = 0; k < 3; ++k) {
    const std::size_t phase = of.phase[k];
    const bool shows = (config_.shunts >> k & 1) != 0 && plant::is_low(of.legs[phase]);
    leg[k] = config_.shunts == 0 || shows ? &of.y.i[phase] : &none;
  }
  const auto show = [&](double s) {
    const series::LagWeights w = weights(config_.amplifier_s, of, s);
    const auto at = [&](const series::Coefficients<Real>& u, const Kept& x) {
      return x.value + series::lag_increment(u, degree, s, w, x.value);
    };
    for (std::size_t k = 0; k < 3; ++k) reading_.i_A[k] = at(*leg[k], i_[k]);
    reading_.dc_link_A = at(link, dc_link_);
  };
  const sim::Instant seen{of.next_sample.ticks - config_.amplifier_delay_ticks, of.next_sample.offset};
  const bool delayed = config_.amplifier_delay_ticks > 0;
  if (delayed && of.from < seen && seen <= of.to && of.y.h > 0)
    show(sim::seconds_between(of.from, seen) / static_cast<double>(of.y.h));
  const auto s = static_cast<double>(of.s);
  const series::LagWeights w = weights(config_.amplifier_s, of, s);
  for (std::size_t k = 0; k < 3; ++k) i_[k].add(series::lag_increment(*leg[k], degree, s, w, i_[k].value));
  dc_link_.add(series::lag_increment(link, degree, s, w, dc_link_.value));
  if (delayed) return;
  for (std::size_t k = 0; k < 3; ++k) reading_.i_A[k] = i_[k].value;
  reading_.dc_link_A = dc_link_.value;
}

template <class Real>
void FrontEnd::follow_legs(double lag_s, const FrontEndSegment<Real>& of,
                           const plant::TerminalSeries<Real>& u, plant::PerLeg<Kept>& kept,
                           plant::PerLeg<double>& shown) {
  const auto s = static_cast<double>(of.s);
  const series::LagWeights w = weights(lag_s, of, s);
  for (std::size_t k = 0; k < 3; ++k) {
    kept[k].add(series::lag_increment(u[of.phase[k]], of.y.degree, s, w, kept[k].value));
    shown[k] = kept[k].value;
  }
}

template <class Real>
void FrontEnd::follow_terminals(const FrontEndSegment<Real>& of, const plant::TerminalSeries<Real>& u) {
  if (reading_.voltages) follow_legs(config_.divider_s, of, u, terminal_, reading_.terminal_V);
  if (config_.has_comparators())
    follow_legs(config_.comparators.lag_s, of, u, comparator_, reading_.comparator_V);
}

/// Empty type for a firmware with ideal measurements.
struct NoFrontEnd {};

}  // namespace sixstep::rig

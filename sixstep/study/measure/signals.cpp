// SPDX-License-Identifier: Apache-2.0
#include "sixstep/study/measure/signals.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "sixstep/study/measure/signal_products.hpp"

namespace sixstep::study {

namespace {

using plant::PerLeg;

/// What stands still from one event to the next.
double constant_value(const SegmentView& g, Signal signal) {
  switch (signal) {
    case Signal::duty:
      return signed_duty(g.modulator, g.plant.sector());
    case Signal::current_reference:
      return g.current_reference_A;
    case Signal::speed_reference:
      return g.speed_reference_rad_s;
    case Signal::position_reference:
      return g.setpoint;
    case Signal::load_torque:
      return g.plant.constants().load;
    default: {
      const auto gate = static_cast<std::size_t>(signal) - static_cast<std::size_t>(Signal::gate_T1);
      const plant::Gates& gates = g.plant.gates();
      return (gate % 2 == 0 ? gates.high : gates.low)[gate / 2] ? 1.0 : 0.0;
    }
  }
}

/// The angle since theta_e = 0, times `per_electrical_rad`; the sectors passed are counted, not summed.
Series angle_series(const SegmentView& g, double per_electrical_rad, double per_sector) {
  Series c = g.plant.expansion().x;
  for (int j = 0; j <= g.plant.expansion().degree; ++j) c[j] *= per_electrical_rad;
  c[0] += static_cast<double>(g.plant.state().sector) * per_sector;
  return c;
}

Series position_series(const SegmentView& g) {
  const double p = g.plant.constants().pole_pairs;
  return angle_series(g, 180.0 / base::pi / p, 60.0 / p);
}

/// reference - measurement.
Series less(double reference, Series c, int degree) {
  for (int j = 0; j <= degree; ++j) c[j] = -c[j];
  c[0] += reference;
  return c;
}

/// A signal that is a sum of the segment's own series: over the whole segment, of the segment's degree.
Series plain_series(const SegmentView& g, Signal signal) {
  const auto& y = g.plant.expansion();
  const auto motor_current = [&] { return weighted_current(motor_current_weights(g.plant.sector()), y); };
  switch (signal) {
    case Signal::current:
      return motor_current();
    case Signal::phase_a:
      return y.i[0];
    case Signal::phase_b:
      return y.i[1];
    case Signal::phase_c:
      return y.i[2];
    case Signal::speed:
      return y.w;
    case Signal::torque:
      return y.torque;
    case Signal::bus_voltage:
      return y.bus;
    case Signal::bus_current:
      return weighted_current(bus_current_weights(g.plant), y);
    case Signal::position:
      return position_series(g);
    case Signal::angle: {
      const double p = g.plant.constants().pole_pairs;
      return angle_series(g, 1.0 / p, base::sector_rad / p);
    }
    case Signal::current_error:
      return less(g.current_reference_A, motor_current(), y.degree);
    case Signal::speed_error:
      return less(g.speed_reference_rad_s, y.w, y.degree);
    case Signal::position_error:
      return less(g.setpoint, position_series(g), y.degree);
    case Signal::load_power: {
      Series c{};
      for (int j = 0; j <= y.degree; ++j) c[j] = g.plant.constants().load * y.w[j];
      return c;
    }
    default:
      return {constant_value(g, signal)};
  }
}

/// Half the sum of the current magnitudes, within a part in which no phase changes its sign.
Series magnitude_series(const SegmentView& g, double from, double to) {
  const auto& y = g.plant.expansion();
  PerLeg<double> half{};
  for (int k = 0; k < 3; ++k) half[k] = series::evaluate(y.i[k], y.degree, (from + to) / 2) < 0 ? -0.5 : 0.5;
  return weighted_current(half, y);
}

}  // namespace

double signed_duty(const rig::Modulator& modulator, int sector) {
  const rig::BoardCommand& command = modulator.command();
  if (!command.enabled) return 0.0;
  const bool compares = command.watch != control::Watch::none;
  const double duty = compares ? (modulator.source_on() ? 1.0 : 0.0) : command.duty;
  const control::Pair positive = control::positive_pair(static_cast<std::uint8_t>(sector));
  return command.pair.source == positive.source ? duty : -duty;
}

bool is_cut(const SegmentView& g, Signal signal) {
  return signal == Signal::current_magnitude ||
         (is_product(signal) && needs_halves(g.plant.expansion().degree));
}

std::vector<double> cuts_of(const SegmentView& g, Signal signal, double from, double to) {
  const auto& y = g.plant.expansion();
  std::vector<double> cuts = {from, to};
  if (signal != Signal::current_magnitude)
    cuts.push_back((from + to) / 2);
  else
    for (int k = 0; k < 3; ++k) {
      const Series i = series::restricted(y.i[k], y.degree, from, to);
      series::for_each_sign_change(i, y.degree, series::magnitude_of(i, y.degree),
                                   [&](double s) { cuts.push_back(from + s * (to - from)); });
    }
  std::sort(cuts.begin(), cuts.end());
  return cuts;
}

Piece piece_of(const SegmentView& g, Signal signal, double from, double to) {
  const int degree = g.plant.expansion().degree;
  if (is_product(signal)) return product_piece(g, signal, from, to);
  const Series c =
      signal == Signal::current_magnitude ? magnitude_series(g, from, to) : plain_series(g, signal);
  return {from == 0.0 && to == 1.0 ? c : series::restricted(c, degree, from, to), degree};
}

double signal_now(const SegmentView& g, Signal signal) {
  if (signal != Signal::current_magnitude) return piece_of(g, signal, 0.0, 1.0).c[0];
  const auto& i = g.plant.expansion().i;
  return (std::fabs(i[0][0]) + std::fabs(i[1][0]) + std::fabs(i[2][0])) / 2;
}

series::Extremes<double> signal_bounds(const SegmentView& g, Signal signal) {
  const auto& y = g.plant.expansion();
  // Sums of up to 16 terms and of three series: rounding is below 32 * 2^-53 of their magnitudes.
  const auto around = [](double middle, double reach) {
    const double wide = reach + 0x1p-48 * (std::fabs(middle) + reach);
    return series::Extremes<double>{middle - wide, middle + wide};
  };
  const auto combined = [&](const PerLeg<double>& w) {
    double middle = 0.0, reach = 0.0;
    for (int k = 0; k < 3; ++k) {
      middle += w[k] * y.i[k][0];
      reach += std::fabs(w[k]) * (y.reach_i[k] + 0x1p-48 * std::fabs(y.i[k][0]));
    }
    return around(middle, reach);
  };
  switch (signal) {
    case Signal::current:
      return combined(motor_current_weights(g.plant.sector()));
    case Signal::phase_a:
      return combined({1.0, 0.0, 0.0});
    case Signal::phase_b:
      return combined({0.0, 1.0, 0.0});
    case Signal::phase_c:
      return combined({0.0, 0.0, 1.0});
    case Signal::bus_current:
      return combined(bus_current_weights(g.plant));
    case Signal::speed:
      return around(y.w[0], y.reach_w);
    default:
      return {-std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};
  }
}

}  // namespace sixstep::study

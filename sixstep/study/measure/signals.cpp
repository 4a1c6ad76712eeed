// SPDX-License-Identifier: Apache-2.0
#include "sixstep/study/measure/signals.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "sixstep/design/sheet/thermal.hpp"
#include "sixstep/study/measure/signal_products.hpp"

namespace sixstep::study {

namespace {

using plant::PerLeg;
using Extremes = series::Extremes<double>;

/// The angle since theta_e = 0, times `per_electrical_rad`. Passed sectors are counted, so that their angles
/// add no rounding.
Series angle_series(const SegmentView& g, double per_electrical_rad, double per_sector) {
  Series c = g.plant.expansion().x;
  for (int j = 0; j <= g.plant.expansion().degree; ++j) c[j] *= per_electrical_rad;
  c[0] += static_cast<double>(g.plant.state().sector) * per_sector;
  return c;
}

Series position_series(const SegmentView& g) {
  const double p = g.plant.pole_pairs();
  return angle_series(g, 180.0 / base::pi / p, 60.0 / p);
}

/// reference - measurement.
Series less(double reference, Series c, int degree) {
  for (int j = 0; j <= degree; ++j) c[j] = -c[j];
  c[0] += reference;
  return c;
}

Series load_torque(const SegmentView& g) {
  if (g.plant.general) return g.plant.general->series().load;
  const auto [load, dry, per_speed] = plant::torques(g.plant.lean->constants(), g.plant.motion());
  return Series{load};
}

/// Bounds with room for rounding: sums of up to 16 terms and of three series have rounding below 32 * 2^-53
/// of their magnitudes.
Extremes around(double middle, double reach) {
  const double wide = reach + 0x1p-48 * (std::fabs(middle) + reach);
  return {middle - wide, middle + wide};
}

Extremes bounds_of_currents(const SegmentView& g, const PerLeg<double>& w) {
  const auto& y = g.plant.expansion();
  double middle = 0.0, reach = 0.0;
  for (int k = 0; k < 3; ++k) {
    middle += w[k] * y.i[k][0];
    reach += std::fabs(w[k]) * (y.reach_i[k] + 0x1p-48 * std::fabs(y.i[k][0]));
  }
  return around(middle, reach);
}

Series motor_current(const SegmentView& g) {
  return weighted_current(motor_current_weights(g.probe_sector), g.plant.expansion());
}

Series mechanical_angle(const SegmentView& g) {
  const double p = g.plant.pole_pairs();
  return angle_series(g, 1.0 / p, base::sector_rad / p);
}

using General = plant::general::Series<double>;

/// A series of the general kernel; 0 with the lean kernel.
Series of_general(const SegmentView& g, Series General::*which) {
  return g.plant.general ? g.plant.general->series().*which : Series{};
}

/// Without a thermal simulation the junction has the temperature at which the sheet's values apply.
Series junction_temperature(const SegmentView& g) {
  return {g.plant.general ? g.plant.general->heat().hottest_junction_degC() : design::sheet_degC};
}

/// A parabola through beginning, middle and end suffices, because a segment is short compared with the
/// thermal time constants.
Series temperature(const SegmentView& g, double plant::BodyTemperatures::*which) {
  if (!g.plant.general) return {design::sheet_degC};
  const auto at = [&](double s) { return g.plant.general->bodies_degC(s).*which; };
  const double begin = at(0), middle = at(0.5) - begin, end = at(1) - begin;
  if (g.plant.expansion().degree < 2) return {begin, end};
  return {begin, 4 * middle - end, 2 * (end - 2 * middle)};
}

Series load_speed(const SegmentView& g) {
  return g.plant.general ? g.plant.general->series().load_w : g.plant.expansion().w;
}

Series load_angle(const SegmentView& g) {
  if (!g.plant.general) return mechanical_angle(g);
  const auto& c = g.plant.general->constants();
  const double p = g.plant.pole_pairs() * c.gear;
  Series angle = angle_series(g, 1.0 / p, base::sector_rad / p);
  for (int j = 0; c.elastic && j <= g.plant.expansion().degree; ++j)
    angle[j] -= g.plant.general->series().twist[j];
  return angle;
}

/// The source's current: (V_0 - U_s)/R_b, with its open-circuit voltage V_0 and resistance R_b and the bus
/// voltage U_s. With a stiff bus it equals the bus current.
Series source_current(const SegmentView& g) {
  const auto& y = g.plant.expansion();
  const bool has_capacitor =
      g.plant.lean ? g.plant.lean->constants().inv_C > 0 : g.plant.general->constants().inv_C > 0;
  if (!has_capacitor) return weighted_current(bus_current_weights(g.plant), y);
  if (g.plant.general) return g.plant.general->series().source;
  const auto& c = g.plant.lean->constants();
  if (!g.plant.lean->mode().source_feeds) return {};
  Series out = less(c.V_0, y.bus, y.degree);
  for (int j = 0; j <= y.degree; ++j) out[j] *= c.inv_R_b;
  return out;
}

Series capacitor_current(const SegmentView& g) {
  if (g.plant.general && g.plant.general->constants().inv_C > 0) return g.plant.general->series().capacitor_A;
  const auto& y = g.plant.expansion();
  Series out = source_current(g);
  const Series drawn = weighted_current(bus_current_weights(g.plant), y);
  for (int j = 0; j <= y.degree; ++j) out[j] -= drawn[j];
  return out;
}

template <unsigned n>
Series gate(const SegmentView& g) {
  return {(n % 2 == 0 ? g.gates.high : g.gates.low)[n / 2] ? 1.0 : 0.0};
}

template <int k>
Series phase(const SegmentView& g) {
  return g.plant.expansion().i[k];
}
template <int k>
Extremes phase_bounds(const SegmentView& g) {
  PerLeg<double> weights{};
  weights[k] = 1.0;
  return bounds_of_currents(g, weights);
}

/// A signal that is constant or a sum of the segment's own series, over the whole segment and with its
/// degree.
struct PlainSignal {
  Signal signal;
  Series (*series)(const SegmentView&);
  Extremes (*bounds)(const SegmentView&) = nullptr;  ///< set if the expansion has bounds for the signal
};
constexpr PlainSignal plain_signals[] = {
    {Signal::current, motor_current,
     [](const SegmentView& g) { return bounds_of_currents(g, motor_current_weights(g.probe_sector)); }},
    {Signal::phase_a, phase<0>, phase_bounds<0>},
    {Signal::phase_b, phase<1>, phase_bounds<1>},
    {Signal::phase_c, phase<2>, phase_bounds<2>},
    {Signal::speed, [](const SegmentView& g) { return g.plant.expansion().w; },
     [](const SegmentView& g) { return around(g.plant.expansion().w[0], g.plant.expansion().reach_w); }},
    {Signal::position, position_series},
    {Signal::torque, [](const SegmentView& g) { return g.plant.expansion().torque; }},
    {Signal::bus_voltage, [](const SegmentView& g) { return g.plant.expansion().bus; }},
    {Signal::bus_current,
     [](const SegmentView& g) { return weighted_current(bus_current_weights(g.plant), g.plant.expansion()); },
     [](const SegmentView& g) { return bounds_of_currents(g, bus_current_weights(g.plant)); }},
    {Signal::angle, mechanical_angle},
    {Signal::duty, [](const SegmentView& g) { return Series{signed_duty(g.modulator, g.board_sector)}; }},
    {Signal::current_reference, [](const SegmentView& g) { return Series{g.current_reference_A}; }},
    {Signal::speed_reference, [](const SegmentView& g) { return Series{g.speed_reference_rad_s}; }},
    {Signal::position_reference, [](const SegmentView& g) { return Series{g.position_reference_deg}; }},
    {Signal::current_error,
     [](const SegmentView& g) {
       return less(g.current_reference_A, motor_current(g), g.plant.expansion().degree);
     }},
    {Signal::speed_error,
     [](const SegmentView& g) {
       return less(g.speed_reference_rad_s, g.plant.expansion().w, g.plant.expansion().degree);
     }},
    {Signal::position_error,
     [](const SegmentView& g) {
       return less(g.position_reference_deg, position_series(g), g.plant.expansion().degree);
     }},
    {Signal::load_torque, load_torque},
    {Signal::load_speed, load_speed},
    {Signal::load_angle, load_angle},
    {Signal::source_current, source_current},
    {Signal::capacitor_current, capacitor_current},
    {Signal::battery_charge, [](const SegmentView& g) { return of_general(g, &General::charge); }},
    {Signal::battery_recovery, [](const SegmentView& g) { return of_general(g, &General::slow); }},
    {Signal::loop_current, [](const SegmentView& g) { return of_general(g, &General::loop); }},
    {Signal::winding_temperature,
     [](const SegmentView& g) { return temperature(g, &plant::BodyTemperatures::winding); }},
    {Signal::housing_temperature,
     [](const SegmentView& g) { return temperature(g, &plant::BodyTemperatures::housing); }},
    {Signal::junction_temperature, junction_temperature},
    {Signal::direct_current, [](const SegmentView& g) { return Series{g.field.measured_A.d}; }},
    {Signal::quadrature_current, [](const SegmentView& g) { return Series{g.field.measured_A.q}; }},
    {Signal::direct_current_reference, [](const SegmentView& g) { return Series{g.field.reference_A.d}; }},
    {Signal::quadrature_current_reference,
     [](const SegmentView& g) { return Series{g.field.reference_A.q}; }},
    {Signal::direct_voltage, [](const SegmentView& g) { return Series{g.field.voltage_V.d}; }},
    {Signal::quadrature_voltage, [](const SegmentView& g) { return Series{g.field.voltage_V.q}; }},
    {Signal::angle_error, [](const SegmentView& g) { return Series{g.field.angle_error_deg}; }},
    {Signal::gate_T1, gate<0>},
    {Signal::gate_T2, gate<1>},
    {Signal::gate_T3, gate<2>},
    {Signal::gate_T4, gate<3>},
    {Signal::gate_T5, gate<4>},
    {Signal::gate_T6, gate<5>},
};

/// The row of a plain signal; nullptr for all other signals.
constexpr const PlainSignal* plain(Signal signal) {
  for (const PlainSignal& row : plain_signals)
    if (row.signal == signal) return &row;
  return nullptr;
}

static_assert([] {
  for (const SignalFact& fact : signal_facts) {
    const bool by_parts = is_product(fact.signal) || fact.kind == SignalKind::magnitude;
    if ((plain(fact.signal) != nullptr) == by_parts) return false;
  }
  return true;
}());

/// Half the sum of the current magnitudes, within a part in which no phase changes its sign.
Series magnitude_series(const SegmentView& g, double from, double to) {
  const auto& y = g.plant.expansion();
  PerLeg<double> half{};
  for (int k = 0; k < 3; ++k) half[k] = series::evaluate(y.i[k], y.degree, (from + to) / 2) < 0 ? -0.5 : 0.5;
  return weighted_current(half, y);
}

}  // namespace

double signed_duty(const ModulatorView& modulator, int sector) {
  if (modulator.legs) return duty_between(modulator.legs->command());
  const control::Pair positive = control::positive_pair(static_cast<std::uint8_t>(sector));
  if (modulator.pins)
    return modulator.pins->source() == static_cast<int>(positive.source) ? modulator.pins->duty()
                                                                         : -modulator.pins->duty();
  const rig::BoardCommand& command = modulator.pair->command();
  if (!command.enabled) return 0.0;
  const bool compares = command.watch != control::Watch::none;
  const double duty = compares ? (modulator.pair->source_on() ? 1.0 : 0.0) : command.duty;
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
  const PlainSignal* row = plain(signal);
  Piece piece{row ? row->series(g) : magnitude_series(g, from, to), degree};
  if (from != 0.0 || to != 1.0) piece.c = series::restricted(piece.c, degree, from, to);
  return piece;
}

double signal_now(const SegmentView& g, Signal signal) {
  if (signal != Signal::current_magnitude) return piece_of(g, signal, 0.0, 1.0).c[0];
  const auto& i = g.plant.expansion().i;
  return (std::fabs(i[0][0]) + std::fabs(i[1][0]) + std::fabs(i[2][0])) / 2;
}

series::Extremes<double> signal_bounds(const SegmentView& g, Signal signal) {
  const PlainSignal* row = plain(signal);
  if (row && row->bounds) return row->bounds(g);
  return {-std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};
}

}  // namespace sixstep::study

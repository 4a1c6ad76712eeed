// SPDX-License-Identifier: Apache-2.0
// Draws references of every shape, events during the run, and figures.
#include <algorithm>

#include "sixstep/study/scenario/measure_choices.hpp"
#include "tests/fuzz/drawn_parts.hpp"

namespace sixstep::testing {

using namespace study;
using control::Mode;

namespace {

double level(Draw& draw, const Scenario& s, const Scales& of) {
  if (draw.chance(0.1)) return 0.0;
  switch (s.control.mode) {
    case Mode::current:
      return draw.sign() * draw.decades(0.02, 1.0) * of.kept_A;
    case Mode::speed:
      return draw.between(-1.0, 1.0) * of.top_rad_s;
    case Mode::position:
      return draw.between(-90.0, 90.0);
    default:
      return draw.chance(0.2) ? draw.one_of(3) - 1.0 : draw.between(-1.0, 1.0);
  }
}

void draw_levels(Draw& draw, Reference& r, const Scenario& s, const Scales& of, double left_s) {
  const int count = 1 + draw.one_of(4);
  for (int n = 0; n < count; ++n) {
    r.times_s.push_back((n == 0 ? 0.0 : n + draw.between(0.0, 0.5)) / (count + 1.0) * left_s);
    r.values.push_back(level(draw, s, of));
  }
}

/// Draws an instant: at a tick, in the middle of a period, a picosecond after a tick, or anywhere.
double instant(Draw& draw, const Scenario& s) {
  const double period = s.pwm.period_s, any = draw.between(0.0, 0.95) * s.duration_s;
  const double tick = static_cast<double>(static_cast<int>(any / period)) * period;
  const double places[] = {tick, tick + period / 2, tick + 1e-12 * draw.one_of(3), any};
  return std::min(places[draw.one_of(4)], 0.99 * s.duration_s);
}

}  // namespace

Reference drawn_reference(Draw& draw, const Scenario& s, const Scales& of, double left_s) {
  Reference r;
  r.shape = static_cast<Shape>(draw.one_of(7));
  const double a = level(draw, s, of), b = level(draw, s, of), rate = std::max(std::abs(a), 1e-3) / left_s;
  switch (r.shape) {
    case Shape::constant:
      r.value = a;
      break;
    case Shape::steps:
      draw_levels(draw, r, s, of, left_s);
      break;
    case Shape::csv:
      draw_levels(draw, r, s, of, left_s);
      r.interpolation = draw.chance(0.5) ? Interpolation::hold : Interpolation::linear;
      break;
    case Shape::square:
      r.high = a;
      r.low = b;
      r.period_s = left_s * draw.decades(0.05, 2.0);
      break;
    case Shape::ramp:
      r.begin_s = draw.between(0.0, 0.4) * left_s;
      if (draw.chance(0.5)) r.start = b;
      r.end = a;
      if (draw.chance(0.5))
        r.end_s = draw.between(0.5, 1.5) * left_s;
      else
        r.slope = rate * draw.decades(0.5, 20.0);
      break;
    case Shape::sine:
      r.offset = s.control.mode == Mode::duty ? 0.3 * a : a;
      r.amplitude = s.control.mode == Mode::duty ? 0.5 * b : b;
      r.frequency_Hz = std::min(draw.decades(0.2, 10.0) / left_s, 0.4 / s.pwm.period_s);
      r.phase_deg = draw.between(-360.0, 360.0);
      break;
    case Shape::trapezoid:
      r.begin_s = draw.between(0.0, 0.4) * left_s;
      r.end = a;
      r.slope = rate * draw.decades(1.0, 20.0);
      r.acceleration = *r.slope / left_s * draw.decades(1.0, 100.0);
      break;
  }
  return r;
}

void draw_events(Draw& draw, Scenario& s, const Scales& of) {
  if (s.control.drive == FirmwareKind::sensorless && s.sensors.rotor == RotorSensing::hall &&
      draw.chance(0.4)) {
    At at;
    at.time_s = instant(draw, s);
    at.control.sensorless.commutates = static_cast<AtCommutates>(1 + draw.one_of(2));
    s.at.push_back(at);
  }
  for (int n = draw.chance(0.5) ? draw.one_of(4) + 1 : 0; n > 0; --n) {
    At at;
    at.time_s = instant(draw, s);
    switch (draw.one_of(s.control.drive == FirmwareKind::product ? 7 : 6)) {
      case 0:
      case 1:
        if (s.control.mode == Mode::off) continue;
        at.reference = drawn_reference(draw, s, of, s.duration_s - at.time_s);
        break;
      case 2:
        at.supply.voltage_V = draw.between(0.7, 1.04) * of.U_V;
        break;
      case 3:
        at.load.torque_Nm = draw.between(-0.4, 0.4) * of.stall_Nm;
        break;
      case 4:
        at.load.locked = draw.chance(0.5);
        break;
      case 5:
        if (draw.chance(0.5) && s.supply.capacitance_F > 0)
          at.supply.sinks = draw.chance(0.5);
        else
          at.sensors.hall_break = AtHallBreak{1 + draw.one_of(3), static_cast<PinLevel>(draw.one_of(3))};
        break;
      default:
        at.request = static_cast<DriveRequest>(1 + draw.one_of(3));
    }
    s.at.push_back(at);
  }
}

/// Draws figures of every kind. The tests of study::check() cover figures of another signal or mode.
void draw_measures(Draw& draw, Scenario& s) {
  for (int n = draw.one_of(4); n > 0; --n) {
    static constexpr MetricKind kinds[] = {MetricKind::final_value,  MetricKind::mean,
                                           MetricKind::rms,          MetricKind::maximum,
                                           MetricKind::minimum,      MetricKind::peak_to_peak,
                                           MetricKind::ripple_rms,   MetricKind::switching_frequency,
                                           MetricKind::efficiency,   MetricKind::reach_time,
                                           MetricKind::settling_time};
    Requirement r;
    r.measure.metric = kinds[draw.one_of(11)];
    const bool bare =
        r.measure.metric == MetricKind::efficiency || r.measure.metric == MetricKind::switching_frequency;
    if (!bare) r.measure.signal = draw.chance(0.5) ? Signal::phase_a : Signal::speed;
    if (r.measure.metric == MetricKind::reach_time || r.measure.metric == MetricKind::settling_time)
      r.measure.level = draw.between(-10.0, 10.0);
    if (draw.chance(0.5)) r.measure.from_s = draw.between(0.0, 0.5) * s.duration_s;
    if (draw.chance(0.5)) r.measure.to_s = draw.between(0.6, 1.0) * s.duration_s;
    (draw.chance(0.5) ? r.min : r.max) = draw.between(-100.0, 100.0);
    s.require.push_back(r);
  }
}

}  // namespace sixstep::testing

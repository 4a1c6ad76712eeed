// SPDX-License-Identifier: Apache-2.0
#include "sixstep/design/scaling/scaling.hpp"

#include <algorithm>
#include <cmath>

#include "sixstep/base/written.hpp"
#include "sixstep/design/scaling/scaling_proof.hpp"

namespace sixstep::design {

namespace {

using control::DriveConfig;
using control::Mode;

/// Largest magnitudes of what the loops compute, in SI: interval arithmetic around 0 on drive.hpp's lines.
struct Magnitudes {
  double current = 0.0;  ///< phase and motor current
  double current_ref = 0.0;
  double current_levels = 0.0;  ///< reference and band
  double speed = 0.0;
  double speed_ref = 0.0;
  double speed_change = 0.0;  ///< from sample to sample
  double position = 0.0;
  double position_ref = 0.0;
  double voltage = 0.0;  ///< limit of the current PI
  double emf = 0.0;      ///< feed-forward, clamped at that limit
  double bus = 0.0;
};

bool runs_speed(const DriveConfig<double>& d) { return d.mode == Mode::speed || d.mode == Mode::position; }

bool runs_current(const DriveConfig<double>& d) {
  return d.mode == Mode::current || (runs_speed(d) && d.speed_control == control::SpeedControl::cascade);
}

Magnitudes magnitudes(const DriveConfig<double>& d, const OperatingRange& r) {
  Magnitudes m;
  m.current = r.current_A;
  m.speed = r.speed_rad_s;
  m.bus = r.bus_V;
  if (d.mode == Mode::position) {
    m.position = r.position_deg;
    m.position_ref = r.setpoint;
  }
  // A slewed setpoint begins at what is measured.
  const bool slews = d.extras.on && d.extras.slews_setpoint;
  const auto slewed = [slews](double wanted, double measured) {
    return slews ? std::max(wanted, measured) : wanted;
  };
  m.position_ref = slewed(m.position_ref, m.position);
  m.speed_change = r.speed_change_rad_s > 0 ? std::min(r.speed_change_rad_s, 2 * m.speed) : 2 * m.speed;
  if (runs_speed(d))
    m.speed_ref = d.mode == Mode::position ? d.speed_limit_rad_s : slewed(r.setpoint, m.speed);
  if (runs_current(d)) {
    m.current_ref = d.mode == Mode::current ? slewed(r.setpoint, m.current) : d.current_limit_A;
    m.voltage = d.current.limit;
    const bool hysteresis = d.current_control == control::CurrentControl::hysteresis;
    m.current_levels = m.current_ref + (hysteresis ? d.hysteresis.band_A : 0.0);
    if (d.extras.on) m.emf = std::min(d.current.limit, r.speed_rad_s * d.extras.feed_forward.K_t_V_s);
  }
  return m;
}

using detail::full_scale;
using detail::Proof;

constexpr double trip_ratio = 1.25;  // limits.hpp: over_limit

template <class Scalar>
control::LimitsConfig<Scalar> scaled_limits(const control::LimitsConfig<double>& l, const Bases& b,
                                            double largest_speed, Proof<Scalar>& proof) {
  proof.threshold("limits.current_A, 5/4 of it", trip_ratio * l.current_A, b.current_A);
  if (l.limits_speed)
    proof.fits("limits.speed_rad_s with speed", l.speed_rad_s + largest_speed, b.speed_rad_s);
  if (l.limits_regeneration) proof.threshold("limits.bus_V", l.bus_V, b.voltage_V);
  return {Scalar(l.current_A / b.current_A),
          l.limits_speed,
          Scalar(l.speed_rad_s / b.speed_rad_s),
          proof.gain("limits.A_per_rad_s", l.A_per_rad_s * b.speed_rad_s / b.current_A),
          l.limits_regeneration,
          Scalar(l.bus_V / b.voltage_V),
          proof.gain("limits.A_per_V", l.A_per_V * b.voltage_V / b.current_A)};
}

/// pi_positional.hpp and derivative.hpp: |y| <= g times the widest step of the speed, and g/b times its
/// largest change per sample; |I| <= limit + |y| + |K_c| |e|/K_b. K e may saturate. K_i and its increments
/// are those that DriveConfig::speed was proved with.
template <class Scalar>
void scale_positional(const control::DriveExtras<double>& x, const Magnitudes& m, const Bases& b,
                      Proof<Scalar>& proof, control::DriveExtras<Scalar>& out) {
  const control::PiPositionalConfig<double>& pi = x.speed;
  const control::DerivativeConfig<double>& d = x.speed_derivative;
  const double steepest = d.b > 0 ? d.g / d.b * m.speed_change : HUGE_VAL;
  const double braked = d.g > 0 ? std::min(2 * m.speed * d.g, steepest) : 0.0;
  const double integral =
      pi.K_b > 0 ? pi.limit + braked + std::fabs(pi.K_c) / pi.K_b * (m.speed + m.speed_ref) : 0.0;
  if (!(pi.K_b > 0) && pi.K_i != 0)
    proof.problems.push_back({"speed.K_b", "0",
                              "lets the integral grow without an end, which fixed point has",
                              "take K_i/K, or floating point"});
  if (braked + integral > 14.0 * detail::full_scale<Scalar>)
    proof.problems.push_back(
        {"speed derivative and integral", base::written(braked + integral),
         "of full output are above " + base::written(14.0 * detail::full_scale<Scalar>),
         "take K_b nearer K_i/K, a longer filter of the derivative, or a format with more bits "
         "before the point"});
  proof.rows.push_back(
      {"speed derivative and integral", braked + integral, 14.0 * detail::full_scale<Scalar>});
  out.positional_speed = true;
  out.speed = {proof.gain("speed.K", pi.K * b.speed_rad_s), proof.gain("speed.K_i", pi.K_i * b.speed_rad_s),
               proof.gain("speed.K_b", pi.K_b), Scalar(pi.limit),
               proof.gain("speed.K_c", pi.K_c * b.speed_rad_s)};
  out.speed_derivative = {proof.gain("speed_derivative.g", d.g * b.speed_rad_s),
                          proof.gain("speed_derivative.b", d.b)};
}

template <class Scalar>
control::DriveExtras<Scalar> scaled_extras(const DriveConfig<double>& d, const Bases& b, const Magnitudes& m,
                                           Proof<Scalar>& proof) {
  const control::DriveExtras<double>& x = d.extras;
  control::DriveExtras<Scalar> out;
  out.on = x.on;
  if (!x.on) return out;
  out.slews_setpoint = x.slews_setpoint;
  out.slew.step = control::Accumulator<Scalar>(x.slew.step / setpoint_base(d.mode, b));
  if (x.slews_setpoint && x.slew.step != 0 && out.slew.step.raw == 0)
    proof.problems.push_back({"slew.step", base::written(x.slew.step),
                              "is below the last bit of the setpoint's sum",
                              "take 32 bits or slew in a slower tick"});
  out.limits_current = x.limits_current;
  if (x.limits_current) out.limits = scaled_limits(x.limits, b, m.speed, proof);
  out.torque_fraction_per_A = proof.gain("torque_fraction_per_A", x.torque_fraction_per_A * b.current_A);
  out.feed_forward.K_t_V_s =
      proof.gain("feed_forward.K_t_V_s", x.feed_forward.K_t_V_s * b.speed_rad_s / b.voltage_V);
  out.bus.lowest_bus_V = Scalar(x.bus.lowest_bus_V / b.voltage_V);
  if (x.positional_speed) scale_positional(x, m, b, proof, out);
  out.smooth_chopping = x.smooth_chopping;
  out.chopping = {Scalar(x.chopping.soft_above_A / b.current_A),
                  Scalar(x.chopping.complementary_below_A / b.current_A)};
  return out;
}

template <class Scalar>
void prove_signals(const Magnitudes& m, const Bases& b, Proof<Scalar>& proof) {
  proof.fits("current", m.current, b.current_A);
  proof.fits("current reference with band", m.current_levels, b.current_A);
  proof.fits("current error", m.current + m.current_ref, b.current_A);
  proof.fits("speed", m.speed, b.speed_rad_s);
  proof.fits("speed error", m.speed + m.speed_ref, b.speed_rad_s);
  proof.fits("position", m.position, b.position_deg);
  proof.fits("position error", m.position + m.position_ref, b.position_deg);
  proof.fits("voltage with feed-forward", m.voltage + m.emf, b.voltage_V);
  proof.fits("bus", m.bus, b.voltage_V);
}

}  // namespace

Bases bases_for(const DriveConfig<double>& drive, const OperatingRange& range, double scale) {
  const Magnitudes m = magnitudes(drive, range);
  const auto base = [scale](double largest) { return largest > 0 ? largest / scale : 1.0; };
  double speed = m.speed + m.speed_ref, bus = std::max(m.bus, drive.nominal_bus_V);
  double current = std::max(m.current + m.current_ref, m.current_levels);
  if (drive.extras.on && drive.extras.limits_current) {
    const control::LimitsConfig<double>& l = drive.extras.limits;
    const double below_the_end = 1 + 1e-3;  // a threshold at full scale is never passed
    current = std::max(current, trip_ratio * l.current_A * below_the_end);
    if (l.limits_speed) speed = std::max(speed, m.speed + l.speed_rad_s);
    if (l.limits_regeneration) bus = std::max(bus, l.bus_V * below_the_end);
  }
  return {base(current), base(std::max(m.voltage + m.emf, bus)), base(speed),
          base(m.position + m.position_ref)};
}

template <class Scalar>
base::Result<Scaled<Scalar>> scaled(const DriveConfig<double>& d, const OperatingRange& range,
                                    const Bases& b) {
  Proof<Scalar> proof;
  const Magnitudes m = magnitudes(d, range);
  prove_signals(m, b, proof);
  DriveConfig<Scalar> c;
  c.mode = d.mode;
  c.chopping = d.chopping;
  c.current_control = d.current_control;
  c.speed_control = d.speed_control;
  if (runs_current(d)) {
    c.current = proof.pi("current", d.current, b.current_A, b.voltage_V, m.current + m.current_ref);
    c.hysteresis = {Scalar(d.hysteresis.band_A / b.current_A), d.hysteresis.watch};
    if (d.nominal_bus_V > 0) {
      c.nominal_bus_V = control::Divisor<Scalar>(d.nominal_bus_V / b.voltage_V);
      proof.gain("1/nominal_bus_V", b.voltage_V / d.nominal_bus_V);
    }
  }
  if (runs_speed(d)) {
    c.speed = proof.pi("speed", d.speed, b.speed_rad_s, 1.0, m.speed + m.speed_ref);
    c.current_at_full_torque_A =
        proof.gain("current_at_full_torque_A", d.current_at_full_torque_A / b.current_A);
    c.current_limit_A = Scalar(d.current_limit_A / b.current_A);
    c.position_gain = proof.gain("position_gain", d.position_gain * b.position_deg / b.speed_rad_s);
    c.speed_limit_rad_s = Scalar(d.speed_limit_rad_s / b.speed_rad_s);
  }
  c.extras = scaled_extras(d, b, m, proof);
  if (!proof.problems.empty()) return proof.problems;
  return Scaled<Scalar>{c, b, std::move(proof.rows)};
}

template <class Scalar>
base::Result<Scaled<Scalar>> scaled(const DriveConfig<double>& d, const OperatingRange& range) {
  return scaled<Scalar>(d, range, bases_for(d, range, full_scale<Scalar>));
}

using Drive = DriveConfig<double>;
using Range = OperatingRange;
template base::Result<Scaled<control::Q15>> scaled(const Drive&, const Range&, const Bases&);
template base::Result<Scaled<control::Q31>> scaled(const Drive&, const Range&, const Bases&);
template base::Result<Scaled<control::Q14>> scaled(const Drive&, const Range&, const Bases&);
template base::Result<Scaled<control::Q30>> scaled(const Drive&, const Range&, const Bases&);
template base::Result<Scaled<control::Fixed<std::int16_t, 13>>> scaled(const Drive&, const Range&,
                                                                       const Bases&);
template base::Result<Scaled<control::Fixed<std::int32_t, 29>>> scaled(const Drive&, const Range&,
                                                                       const Bases&);
template base::Result<Scaled<control::Q15>> scaled(const Drive&, const Range&);
template base::Result<Scaled<control::Q31>> scaled(const Drive&, const Range&);
template base::Result<Scaled<control::Q14>> scaled(const Drive&, const Range&);
template base::Result<Scaled<control::Q30>> scaled(const Drive&, const Range&);
template base::Result<Scaled<control::Fixed<std::int16_t, 13>>> scaled(const Drive&, const Range&);
template base::Result<Scaled<control::Fixed<std::int32_t, 29>>> scaled(const Drive&, const Range&);

}  // namespace sixstep::design

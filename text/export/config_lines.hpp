// SPDX-License-Identifier: Apache-2.0
// The drive's configuration (drive.hpp) as C++ assignments.
#pragma once
#include "sixstep/control/drive.hpp"
#include "sixstep/study/scenario/choices.hpp"
#include "text/export/config_text.hpp"

namespace text {

namespace words {
using sixstep::base::Choice;
using namespace sixstep::control;
inline constexpr Choice<CurrentControl> current_control[] = {{"pi", CurrentControl::pi, ""},
                                                             {"hysteresis", CurrentControl::hysteresis, ""}};
inline constexpr Choice<SpeedControl> speed_control[] = {{"cascade", SpeedControl::cascade, ""},
                                                         {"duty", SpeedControl::duty, ""}};
inline constexpr Choice<Watch> watch[] = {
    {"none", Watch::none, ""}, {"motor", Watch::motor, ""}, {"phase", Watch::phase, ""}};
}  // namespace words

namespace detail {

template <class Scalar>
void limits_lines(ConfigText<Scalar>& t, const sixstep::control::LimitsConfig<double>& d,
                  const sixstep::control::LimitsConfig<Scalar>& k) {
  const sixstep::design::Bases& b = t.bases();
  t.signal("extras.limits.current_A", k.current_A, d.current_A, b.current_A, "A");
  t.flag("extras.limits.limits_speed", k.limits_speed);
  t.signal("extras.limits.speed_rad_s", k.speed_rad_s, d.speed_rad_s, b.speed_rad_s, "rad/s");
  t.gain("extras.limits.A_per_rad_s", k.A_per_rad_s, d.A_per_rad_s, b.current_A / b.speed_rad_s,
         "A per rad/s");
  t.flag("extras.limits.limits_regeneration", k.limits_regeneration);
  t.signal("extras.limits.bus_V", k.bus_V, d.bus_V, b.voltage_V, "V");
  t.gain("extras.limits.A_per_V", k.A_per_V, d.A_per_V, b.current_A / b.voltage_V, "A per V");
}

template <class Scalar>
void extras_lines(ConfigText<Scalar>& t, sixstep::control::Mode mode,
                  const sixstep::control::DriveExtras<double>& d,
                  const sixstep::control::DriveExtras<Scalar>& k) {
  const sixstep::design::Bases& b = t.bases();
  t.flag("extras.on", k.on);
  t.flag("extras.slews_setpoint", k.slews_setpoint);
  double step = d.slew.step;
  if constexpr (ConfigText<Scalar>::fixed)
    step = std::ldexp(static_cast<double>(k.slew.step.raw),
                      -Scalar::fraction_bits - decltype(k.slew.step)::guard_bits) *
           sixstep::design::setpoint_base(mode, b);
  if (literal(k.slew.step) != literal(sixstep::control::Accumulator<Scalar>{}))
    t.number("extras.slew.step", literal(k.slew.step), d.slew.step, step,
             sixstep::study::reference_unit(mode), "per tick");
  t.flag("extras.limits_current", k.limits_current);
  if (k.limits_current) limits_lines(t, d.limits, k.limits);
  t.gain("extras.torque_fraction_per_A", k.torque_fraction_per_A, d.torque_fraction_per_A, 1 / b.current_A,
         "per A");
  t.gain("extras.feed_forward.K_t_V_s", k.feed_forward.K_t_V_s, d.feed_forward.K_t_V_s,
         b.voltage_V / b.speed_rad_s, "V per rad/s");
  t.signal("extras.bus.lowest_bus_V", k.bus.lowest_bus_V, d.bus.lowest_bus_V, b.voltage_V, "V");
  t.flag("extras.smooth_chopping", k.smooth_chopping);
  t.signal("extras.chopping.soft_above_A", k.chopping.soft_above_A, d.chopping.soft_above_A, b.current_A,
           "A");
  t.signal("extras.chopping.complementary_below_A", k.chopping.complementary_below_A,
           d.chopping.complementary_below_A, b.current_A, "A");
  t.flag("extras.positional_speed", k.positional_speed);
  t.gain("extras.speed.K", k.speed.K, d.speed.K, 1 / b.speed_rad_s, "per rad/s");
  t.gain("extras.speed.K_i", k.speed.K_i, d.speed.K_i, 1 / b.speed_rad_s, "per rad/s", "per sample");
  t.gain("extras.speed.K_b", k.speed.K_b, d.speed.K_b, 1.0, "", "of what the limit cuts off, per sample");
  t.signal("extras.speed.limit", k.speed.limit, d.speed.limit, 1.0, "of full torque");
  t.gain("extras.speed.K_c", k.speed.K_c, d.speed.K_c, 1 / b.speed_rad_s, "per rad/s",
         "at the limit, per sample");
  t.gain("extras.speed_derivative.g", k.speed_derivative.g, d.speed_derivative.g, 1 / b.speed_rad_s,
         "per rad/s");
  t.gain("extras.speed_derivative.b", k.speed_derivative.b, d.speed_derivative.b, 1.0, "", "per sample");
}

}  // namespace detail

/// `designed` in SI beside `kept` in the target's arithmetic.
template <class Scalar>
std::string drive_lines(const sixstep::control::DriveConfig<double>& d,
                        const sixstep::control::DriveConfig<Scalar>& k, const sixstep::design::Bases& b) {
  ConfigText<Scalar> t(b);
  t.choice("mode", "Mode", d.mode, sixstep::study::mode_choices);
  t.choice("chopping", "Chopping", d.chopping, sixstep::study::chopping_choices);
  t.choice("current_control", "CurrentControl", d.current_control, words::current_control);
  t.choice("speed_control", "SpeedControl", d.speed_control, words::speed_control);
  t.choice("hysteresis.watch", "Watch", k.hysteresis.watch, words::watch);
  t.pi("current", d.current, k.current, b.current_A, b.voltage_V, "V/A", "V");
  t.signal("hysteresis.band_A", k.hysteresis.band_A, d.hysteresis.band_A, b.current_A, "A");
  if (k.nominal_bus_V > sixstep::control::Divisor<Scalar>{}) {
    double held = d.nominal_bus_V;
    if constexpr (ConfigText<Scalar>::fixed)
      held = b.voltage_V / static_cast<double>(k.nominal_bus_V.reciprocal);
    t.number("nominal_bus_V", literal(k.nominal_bus_V), d.nominal_bus_V, held, "V", "duty 1");
  }
  t.pi("speed", d.speed, k.speed, b.speed_rad_s, 1.0, "per rad/s", "of full torque");
  t.gain("current_at_full_torque_A", k.current_at_full_torque_A, d.current_at_full_torque_A, b.current_A, "A",
         "torque limit over K_t");
  t.signal("current_limit_A", k.current_limit_A, d.current_limit_A, b.current_A, "A");
  t.gain("position_gain", k.position_gain, d.position_gain, b.speed_rad_s / b.position_deg, "rad/s per deg");
  t.signal("speed_limit_rad_s", k.speed_limit_rad_s, d.speed_limit_rad_s, b.speed_rad_s, "rad/s");
  if (d.extras.on) detail::extras_lines(t, d.mode, d.extras, k.extras);
  return t.text();
}

}  // namespace text

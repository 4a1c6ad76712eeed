// SPDX-License-Identifier: Apache-2.0
// Lists every field of the drive's configuration (control/drive.hpp) once, in the order of an exported
// header. Each list binds all members of its struct: the list does not compile if a member is missing.
#pragma once
#include "sixstep/control/drive.hpp"
#include "sixstep/design/fields/field.hpp"

namespace sixstep::design {

/// True if a drive runs the loop that the function's name contains.
template <class Scalar>
constexpr bool runs_speed(const control::DriveConfig<Scalar>& d) {
  return d.mode == control::Mode::speed || d.mode == control::Mode::position;
}
template <class Scalar>
constexpr bool runs_current(const control::DriveConfig<Scalar>& d) {
  return d.mode == control::Mode::current ||
         (runs_speed(d) && d.speed_control == control::SpeedControl::cascade);
}

/// Units and bases of a PI's input and output.
struct PiUse {
  Ratio ratio;
  const char* per = "";         ///< unit of the gains
  const char* limit_unit = "";  ///< unit of the output
};

template <class Walk, class Kept>
void fields(Walk&& w, const control::PiConfig<double>& d, Kept& kept, const PiUse& use) {
  const auto& [d1, d0, limit] = d;
  auto& [kept_d1, kept_second, kept_limit] = kept;
  w.gain({"d1", use.per}, d1, kept_d1, use.ratio);
  if constexpr (requires { kept.K_i; })  // the fixed-point configuration stores the sum K_i (pi.hpp)
    w.gain({"K_i", use.per, "d1 + d0, per sample"}, d1 + d0, kept_second, use.ratio);
  else
    w.gain({"d0", use.per}, d0, kept_second, use.ratio);
  w.signal({"limit", use.limit_unit}, limit, kept_limit, use.ratio.out);
}

template <class Walk, class Kept>
void fields(Walk&& w, const control::SlewConfig<double>& d, Kept& kept) {
  auto& [step] = kept;
  w.sum({"step", "", "per tick"}, d.step, step, Base::setpoint);
}

template <class Walk, class Kept>
void fields(Walk&& w, const control::LimitsConfig<double>& d, Kept& kept) {
  auto& [current_A, limits_speed, speed_rad_s, A_per_rad_s, limits_regeneration, bus_V, A_per_V] = kept;
  w.signal({"current_A", "A"}, d.current_A, current_A, Base::current);
  w.flag({"limits_speed"}, d.limits_speed, limits_speed);
  w.signal({"speed_rad_s", "rad/s"}, d.speed_rad_s, speed_rad_s, Base::speed);
  w.gain({"A_per_rad_s", "A per rad/s"}, d.A_per_rad_s, A_per_rad_s, {Base::current, Base::speed});
  w.flag({"limits_regeneration"}, d.limits_regeneration, limits_regeneration);
  w.signal({"bus_V", "V"}, d.bus_V, bus_V, Base::voltage);
  w.gain({"A_per_V", "A per V"}, d.A_per_V, A_per_V, {Base::current, Base::voltage});
}

template <class Walk, class Kept>
void fields(Walk&& w, const control::FeedForwardConfig<double>& d, Kept& kept) {
  auto& [K_t_V_s] = kept;
  w.gain({"K_t_V_s", "V per rad/s"}, d.K_t_V_s, K_t_V_s, {Base::voltage, Base::speed});
}

template <class Walk, class Kept>
void fields(Walk&& w, const control::BusCompensationConfig<double>& d, Kept& kept) {
  auto& [lowest_bus_V] = kept;
  w.signal({"lowest_bus_V", "V"}, d.lowest_bus_V, lowest_bus_V, Base::voltage);
}

template <class Walk, class Kept>
void fields(Walk&& w, const control::SmoothChoppingConfig<double>& d, Kept& kept) {
  auto& [soft_above_A, complementary_below_A] = kept;
  w.signal({"soft_above_A", "A"}, d.soft_above_A, soft_above_A, Base::current);
  w.signal({"complementary_below_A", "A"}, d.complementary_below_A, complementary_below_A, Base::current);
}

template <class Walk, class Kept>
void fields(Walk&& w, const control::PwmPatternConfig<double>& d, Kept& kept) {
  auto& [pattern, half_sector_per_rad_s] = kept;
  w.choice({"pattern"}, d.pattern, pattern, control::PwmPattern::upper);
  w.gain({"half_sector_per_rad_s", "per rad/s", "half sectors (30 electrical degrees) per sample"},
         d.half_sector_per_rad_s, half_sector_per_rad_s, {Base::one, Base::speed});
}

template <class Walk, class Kept>
void fields(Walk&& w, const control::HeldWinding<double>& d, Kept& kept) {
  auto& [decay, A_per_V] = kept;
  w.gain({"decay"}, d.decay, decay, Ratio{});
  w.gain({"A_per_V", "A per V"}, d.A_per_V, A_per_V, {Base::current, Base::voltage});
}

template <class Walk, class Kept>
void fields(Walk&& w, const control::DeadbeatConfig<double>& d, Kept& kept) {
  auto& [wait, rest, decay, V_per_A, correction_V_per_A, K_t_V_s, limit] = kept;
  constexpr Ratio of_current{Base::voltage, Base::current};
  w.part("wait", d.wait, wait);
  w.part("rest", d.rest, rest);
  w.gain({"decay", "", "over a period"}, d.decay, decay, Ratio{});
  w.gain({"V_per_A", "V per A"}, d.V_per_A, V_per_A, of_current);
  w.gain({"correction_V_per_A", "V per A", "per ampere of prediction error"}, d.correction_V_per_A,
         correction_V_per_A, of_current);
  w.gain({"K_t_V_s", "V per rad/s"}, d.K_t_V_s, K_t_V_s, {Base::voltage, Base::speed});
  w.signal({"limit", "V"}, d.limit, limit, Base::voltage);
}

template <class Walk, class Kept>
void fields(Walk&& w, const control::CommutationStepConfig<double>& d, Kept& kept) {
  auto& [K_t_V_s, V_per_A, A_per_V, overlap_bus_V, missing_V_per_A, flanks_per_rad_s, ahead_per_rad_s,
         flat_flanks] = kept;
  w.gain({"K_t_V_s", "V per rad/s", "2 E"}, d.K_t_V_s, K_t_V_s, {Base::voltage, Base::speed});
  w.gain({"V_per_A", "V per A", "3 R/2"}, d.V_per_A, V_per_A, {Base::voltage, Base::current});
  w.gain({"A_per_V", "A per V", "T/L times half a period plus the command's delay"}, d.A_per_V, A_per_V,
         {Base::current, Base::voltage});
  w.signal({"overlap_bus_V", "V"}, d.overlap_bus_V, overlap_bus_V, Base::voltage);
  w.gain({"missing_V_per_A", "V per A"}, d.missing_V_per_A, missing_V_per_A, {Base::voltage, Base::current});
  w.gain({"flanks_per_rad_s", "per rad/s"}, d.flanks_per_rad_s, flanks_per_rad_s, {Base::one, Base::speed});
  w.gain({"ahead_per_rad_s", "per rad/s"}, d.ahead_per_rad_s, ahead_per_rad_s, {Base::one, Base::speed});
  w.signal({"flat_flanks"}, d.flat_flanks, flat_flanks, Base::one);
}

/// Fields of a positional PI whose input is a speed.
template <class Walk, class Kept>
void fields(Walk&& w, const control::PiPositionalConfig<double>& d, Kept& kept) {
  constexpr Ratio of_speed{Base::one, Base::speed};
  auto& [K, K_i, K_b, limit, K_c] = kept;
  w.gain({"K", "per rad/s"}, d.K, K, of_speed);
  w.gain({"K_i", "per rad/s", "per sample"}, d.K_i, K_i, of_speed);
  w.gain({"K_b", "", "fraction of the clamped excess, subtracted per sample"}, d.K_b, K_b, Ratio{});
  w.signal({"limit", "of full torque"}, d.limit, limit, Base::one);
  w.gain({"K_c", "per rad/s", "at the limit, per sample"}, d.K_c, K_c, of_speed);
}

/// Fields of a derivative whose input is a speed.
template <class Walk, class Kept>
void fields(Walk&& w, const control::DerivativeConfig<double>& d, Kept& kept) {
  auto& [g, b] = kept;
  w.gain({"g", "per rad/s"}, d.g, g, {Base::one, Base::speed});
  w.gain({"b", "", "per sample"}, d.b, b, Ratio{});
}

template <class Walk, class Kept>
void fields(Walk&& w, const control::ObservedSpeedConfig<double>& d, Kept& kept) {
  auto& [a, b, c, L_w, L_l, K, f, g] = kept;
  w.signal({"a", "", "fraction of the speed kept per sample"}, d.a, a, Base::one);
  w.signal({"b", "rad/s", "added by a sample of full torque"}, d.b, b, Base::speed);
  w.signal({"c", "", "fraction of the torque kept per sample"}, d.c, c, Base::one);
  w.signal({"L_w", "", "correction of the speed"}, d.L_w, L_w, Base::one);
  w.signal({"L_l", "per rad/s", "correction of the load"}, d.L_l, L_l, Base::one);
  w.signal({"K", "per rad/s"}, d.K, K, Base::one);
  w.signal({"f", "per rad/s", "for friction"}, d.f, f, Base::one);
  w.signal({"g", "rad/s", "added by the torque not yet in effect"}, d.g, g, Base::speed);
}

template <class Walk, class Kept>
void fields(Walk&& w, const control::SlidingSpeedConfig<double>& d, Kept& kept) {
  auto& [q, f, reach, layer] = kept;
  w.signal({"q", "", "decay of the error per sample"}, d.q, q, Base::one);
  w.signal({"f", "per rad/s"}, d.f, f, Base::one);
  w.signal({"reach", "of full torque"}, d.reach, reach, Base::one);
  w.signal({"layer", "rad/s"}, d.layer, layer, Base::speed);
}

/// Fields of other laws of the speed loop. They do not exist in fixed point, because their scaling is not
/// proved.
template <class Walk, class Kept>
void fields(Walk&& w, const control::SpeedLaws<double>& d, Kept& kept) {
  if constexpr (requires { kept.observed; }) {
    auto& [observed, sliding] = kept;
    w.part("observed", d.observed, observed);
    w.part("sliding", d.sliding, sliding);
  }
}

/// Fields of a jerk profile. Its scalars have their own units: a walk that converts by bases skips them.
template <class Walk, class Kept>
void fields(Walk&& w, const control::JerkProfileConfig<double>& d, Kept& kept) {
  auto& [counts_per_deg, deg_per_part, rad_s_per_part, rad_s2_per_part, stride_per_tick, acceleration, ticks,
         cells] = kept;
  const control::JerkProfileConfig<double> unset;
  w.signal({"counts_per_deg"}, d.counts_per_deg, counts_per_deg, Base::one);
  w.signal({"deg_per_part", "deg"}, d.deg_per_part, deg_per_part, Base::one);
  w.signal({"rad_s_per_part", "rad/s"}, d.rad_s_per_part, rad_s_per_part, Base::one);
  w.signal({"rad_s2_per_part", "rad/s^2"}, d.rad_s2_per_part, rad_s2_per_part, Base::one);
  w.signal({"stride_per_tick"}, d.stride_per_tick, stride_per_tick, Base::one);
  w.count({"acceleration", "", "counts per stride^2"}, d.acceleration, acceleration, unset.acceleration);
  w.count({"ticks", "", "ticks of a stride"}, d.ticks, ticks, unset.ticks);
  w.count({"cells", "", "strides of the mean"}, d.cells, cells, unset.cells);
}

template <class Walk, class Kept>
void fields(Walk&& w, const control::MotionFeedForwardConfig<double>& d, Kept& kept) {
  auto& [on, per_rad_s2, per_rad_s, coulomb] = kept;
  w.flag({"on"}, d.on, on);
  if (!w.when_on(d.on)) return;
  w.signal({"per_rad_s2", "per rad/s^2"}, d.per_rad_s2, per_rad_s2, Base::one);
  w.signal({"per_rad_s", "per rad/s"}, d.per_rad_s, per_rad_s, Base::one);
  w.signal({"coulomb", "of full torque"}, d.coulomb, coulomb, Base::one);
}

/// Fields of a profiled position. It does not exist in fixed point, because its scaling is not proved.
template <class Walk, class Kept>
void fields(Walk&& w, const control::ProfiledPositionConfig<double>& d, Kept& kept) {
  if constexpr (requires { kept.profile; }) {
    auto& [on, profile, feed_forward] = kept;
    w.flag({"on"}, d.on, on);
    if (!w.when_on(d.on)) return;
    w.part("profile", d.profile, profile);
    w.part("feed_forward", d.feed_forward, feed_forward);
  }
}

template <class Walk, class Kept>
void fields(Walk&& w, const control::DriveExtras<double>& d, Kept& kept) {
  auto& [on, slews_setpoint, slew, limits_current, limits, torque_fraction_per_A, feed_forward, bus,
         smooth_chopping, chopping, pwm, predicts_current, deadbeat, staying_phase, steps_commutation,
         commutation, speed_law, speed, speed_derivative, speed_weight_off, laws, position] = kept;
  w.flag({"on"}, d.on, on);
  constexpr Field torque_fraction{"torque_fraction_per_A", "per A"};
  constexpr Ratio of_current{Base::one, Base::current};
  if (!w.when_on(d.on)) {
    // The speed loop of a field-oriented drive uses this field even without extras.
    if (d.torque_fraction_per_A != 0)
      w.gain(torque_fraction, d.torque_fraction_per_A, torque_fraction_per_A, of_current);
    return;
  }
  w.flag({"slews_setpoint"}, d.slews_setpoint, slews_setpoint);
  w.part("slew", d.slew, slew);
  w.flag({"limits_current"}, d.limits_current, limits_current);
  if (w.when_on(d.limits_current)) w.part("limits", d.limits, limits);
  w.gain(torque_fraction, d.torque_fraction_per_A, torque_fraction_per_A, of_current);
  w.part("feed_forward", d.feed_forward, feed_forward);
  w.part("bus", d.bus, bus);
  w.flag({"smooth_chopping"}, d.smooth_chopping, smooth_chopping);
  w.part("chopping", d.chopping, chopping);
  w.part("pwm", d.pwm, pwm);
  w.flag({"predicts_current"}, d.predicts_current, predicts_current);
  if (w.when_on(d.predicts_current)) w.part("deadbeat", d.deadbeat, deadbeat);
  w.flag({"staying_phase"}, d.staying_phase, staying_phase);
  w.flag({"steps_commutation"}, d.steps_commutation, steps_commutation);
  if (w.when_on(d.steps_commutation)) w.part("commutation", d.commutation, commutation);
  w.part("position", d.position, position);
  w.choice({"speed_law"}, d.speed_law, speed_law, control::SpeedLaw::pi);
  if (!w.when_on(d.speed_law != control::SpeedLaw::pi)) return;
  w.part("speed", d.speed, speed);
  w.part("speed_derivative", d.speed_derivative, speed_derivative);
  w.gain({"speed_weight_off", "per rad/s", "of the setpoint"}, d.speed_weight_off, speed_weight_off,
         {Base::one, Base::speed});
  w.part("laws", d.laws, laws);
}

template <class Walk, class Kept>
void fields(Walk&& w, const control::DriveConfig<double>& d, Kept& kept) {
  auto& [mode, chopping, current_control, current, hysteresis, nominal_bus_V, speed, current_at_full_torque_A,
         current_limit_A, position_gain, speed_limit_rad_s, speed_control, extras] = kept;
  auto& [band_A, watch] = hysteresis;
  using control::CurrentControl, control::SpeedControl, control::Watch;
  const bool current_runs = w.when_run(runs_current(d)), speed_runs = w.when_run(runs_speed(d));
  w.choice({.name = "mode", .always = true}, d.mode, mode, control::Mode::off);
  w.choice({.name = "chopping", .always = true}, d.chopping, chopping, control::Chopping::soft);
  w.choice({.name = "current_control", .always = true}, d.current_control, current_control,
           CurrentControl::pi);
  w.choice({.name = "speed_control", .always = true}, d.speed_control, speed_control, SpeedControl::cascade);
  w.choice({.name = "hysteresis.watch", .always = true}, current_runs ? d.hysteresis.watch : Watch::motor,
           watch, Watch::motor);
  if (current_runs) {
    w.part("current", d.current, current, PiUse{{Base::voltage, Base::current}, "V/A", "V"});
    w.signal({"hysteresis.band_A", "A"}, d.hysteresis.band_A, band_A, Base::current);
    w.divisor({"nominal_bus_V", "V", "duty 1"}, d.nominal_bus_V, nominal_bus_V, Base::voltage);
  }
  if (speed_runs) {
    w.part("speed", d.speed, speed, PiUse{{Base::one, Base::speed}, "per rad/s", "of full torque"});
    w.gain({"current_at_full_torque_A", "A", "torque limit divided by the motor's torque per ampere"},
           d.current_at_full_torque_A, current_at_full_torque_A, {Base::current, Base::one});
    w.signal({"current_limit_A", "A"}, d.current_limit_A, current_limit_A, Base::current);
    w.gain({"position_gain", "rad/s per deg"}, d.position_gain, position_gain, {Base::speed, Base::position});
    w.signal({"speed_limit_rad_s", "rad/s"}, d.speed_limit_rad_s, speed_limit_rad_s, Base::speed);
  }
  w.part("extras", d.extras, extras);
}

}  // namespace sixstep::design

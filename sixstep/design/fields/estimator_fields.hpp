// SPDX-License-Identifier: Apache-2.0
// Lists every field of the magnet's estimator (control/field/magnet_estimator.hpp) once. The estimator exists
// in floating point only, because its scaling is not proved. Each list binds all members of its struct: the
// list does not compile if a member is missing. Angles and times are integers.
#pragma once
#include "sixstep/control/field/sensorless_field_drive.hpp"
#include "sixstep/design/fields/field_drive_fields.hpp"

namespace sixstep::design {

template <class Walk, class Kept>
void fields(Walk&& w, const control::TrackingConfig& c, Kept& kept) {
  auto& [K_p, K_i] = kept;
  const control::FixedGain<std::int32_t> none{};
  w.count({"K_p", "", "per tick"}, c.K_p, K_p, none);
  w.count({"K_i", "", "per tick"}, c.K_i, K_i, none);
}

template <class Walk, class Kept>
void fields(Walk&& w, const control::InjectionConfig<double>& c, Kept& kept) {
  auto& [voltage_V, rad_per_A] = kept;
  w.signal({"voltage_V", "V"}, c.voltage_V, voltage_V, Base::voltage);
  w.gain({"rad_per_A", "rad per A"}, c.rad_per_A, rad_per_A, {Base::one, Base::current});
}

template <class Walk, class Kept>
void fields(Walk&& w, const control::PolarityConfig<double>& c, Kept& kept) {
  auto& [current_A, certain, settle_ticks, look_ticks] = kept;
  constexpr control::PolarityConfig<double> unset{};
  w.signal({"current_A", "A"}, c.current_A, current_A, Base::current);
  w.gain({"certain"}, c.certain, certain, {Base::one, Base::one});
  w.count({"settle_ticks"}, c.settle_ticks, settle_ticks, unset.settle_ticks);
  w.count({"look_ticks"}, c.look_ticks, look_ticks, unset.look_ticks);
}

template <class Walk, class Kept>
void fields(Walk&& w, const control::ActiveFluxConfig<double>& c, Kept& kept) {
  auto& [period_s, R_ohm, L_q_H, L_D_H, magnet_Vs, pull] = kept;
  const Ratio any{Base::one, Base::one};
  w.gain({"period_s", "s"}, c.period_s, period_s, any);
  w.gain({"R_ohm", "ohm"}, c.R_ohm, R_ohm, {Base::voltage, Base::current});
  w.gain({"L_q_H", "H"}, c.L_q_H, L_q_H, any);
  w.gain({"L_D_H", "H", "L_d - L_q"}, c.L_D_H, L_D_H, any);
  w.signal({"magnet_Vs", "V s"}, c.magnet_Vs, magnet_Vs, Base::one);
  w.gain({"pull"}, c.pull, pull, any);
}

template <class Walk, class Kept>
void fields(Walk&& w, const control::TurnStartConfig<double>& c, Kept& kept) {
  auto& [current_A, align_ticks, step, enough, good_ticks, retries] = kept;
  constexpr control::TurnStartConfig<double> unset{};
  w.signal({"current_A", "A"}, c.current_A, current_A, Base::current);
  w.count({"align_ticks"}, c.align_ticks, align_ticks, unset.align_ticks);
  w.count({"step", "", "2^-48 turns per tick^2"}, c.step, step, unset.step);
  w.count({"enough", "", "2^-48 turns per tick"}, c.enough, enough, unset.enough);
  w.count({"good_ticks"}, c.good_ticks, good_ticks, unset.good_ticks);
  w.count({"retries"}, c.retries, retries, unset.retries);
}

template <class Walk, class Kept>
void fields(Walk&& w, const control::EstimatorConfig<double>& c, Kept& kept) {
  auto& [on, tracking, rad_s, axis_ticks, late, in_middle, injection, north, flux, start, low_rad_s,
         high_rad_s] = kept;
  constexpr control::EstimatorConfig<double> unset{};
  w.flag({"on"}, c.on, on);
  w.part("tracking", c.tracking, tracking);
  w.count({"axis_ticks"}, c.axis_ticks, axis_ticks, unset.axis_ticks);
  w.count({"late", "", "control ticks from an answer to the period in which the answer acts"}, c.late, late,
          unset.late);
  w.flag({"in_middle"}, c.in_middle, in_middle);
  w.gain({"rad_s", "rad/s"}, c.rad_s, rad_s, {Base::speed, Base::one});
  w.part("injection", c.injection, injection);
  w.part("north", c.north, north);
  w.part("flux", c.flux, flux);
  w.part("start", c.start, start);
  w.signal({"low_rad_s", "rad/s"}, c.low_rad_s, low_rad_s, Base::speed);
  w.signal({"high_rad_s", "rad/s"}, c.high_rad_s, high_rad_s, Base::speed);
}

/// Lists all fields except `field`: the field-oriented drive has its own list.
template <class Walk, class Kept>
void fields(Walk&& w, const control::SensorlessFieldConfig<double>& c, Kept& kept) {
  auto& [field, estimator] = kept;
  w.part("estimator", c.estimator, estimator);
}

}  // namespace sixstep::design

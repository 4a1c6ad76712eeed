// SPDX-License-Identifier: Apache-2.0
// Every field of the sensorless drive's configuration (control/sensorless/) around its drive, once. Each list binds all
// members of its struct: a new member stops the compiler here. Times are counts of the timer, voltages counts of the
// converter: only what the loops within are held to is a Scalar.
#pragma once
#include "sixstep/control/sensorless/sensorless_drive.hpp"
#include "sixstep/design/fields/product_fields.hpp"

namespace sixstep::design {

template <class Walk, class Kept>
void fields(Walk&& w, const control::StartUpConfig<double>& d, Kept& kept) {
  auto& [current_A, falling_A, align_ticks, swing_shift, swing_threshold, first_speed, acceleration, jerk,
         last_speed, longest_ticks, trusted, trusted_ticks] = kept;
  w.signal({"current_A", "A"}, d.current_A, current_A, Base::current);
  w.signal({"falling_A", "A"}, d.falling_A, falling_A, Base::current);
  align_ticks = d.align_ticks;
  swing_threshold = d.swing_threshold;
  swing_shift = d.swing_shift;
  first_speed = d.first_speed;
  acceleration = d.acceleration;
  jerk = d.jerk;
  last_speed = d.last_speed;
  longest_ticks = d.longest_ticks;
  trusted = d.trusted;
  trusted_ticks = d.trusted_ticks;
}

template <class Walk, class Kept>
void fields(Walk&& w, const control::SensorlessConfig<double>& d, Kept& kept, bool measures_position) {
  auto& [crossing, captured, clock, spin, start, lock, speed, position] = kept;
  crossing = d.crossing;
  captured = d.captured;
  clock = d.clock;
  spin = d.spin;
  lock = d.lock;
  w.part("start", d.start, start);
  w.part("speed", d.speed, speed);
  if (w.when_run(measures_position)) w.part("position", d.position, position);
}

/// All but the drive, which has fields of its own, and the observer (observer_scaling.hpp).
template <class Walk, class Kept>
void fields(Walk&& w, const control::SensorlessDriveConfig<double>& d, Kept& kept) {
  auto& [drive, sensorless, source, observer, start_output, duty, current, least_duty] = kept;
  source = d.source;
  w.part("sensorless", d.sensorless, sensorless, d.drive.mode == control::Mode::position);
  w.signal({"start_output", "of full torque"}, d.start_output, start_output, Base::one);
  w.sum({"duty.step", "", "per tick"}, d.duty.step, duty.step, Base::one);
  w.sum({"current.step", "A", "per tick"}, d.current.step, current.step, Base::current);
  w.signal({"least_duty"}, d.least_duty, least_duty, Base::one);
}

}  // namespace sixstep::design

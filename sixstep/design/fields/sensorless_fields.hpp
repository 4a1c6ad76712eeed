// SPDX-License-Identifier: Apache-2.0
// Lists every field of the sensorless drive's configuration (control/sensorless/) around its drive once. Each
// list binds all members of its struct: the list does not compile if a member is missing. Times are counts of
// the timer, voltages counts of the converter; only the references and limits of the inner loops are Scalars.
#pragma once
#include "sixstep/control/commissioning/pulse_start.hpp"
#include "sixstep/design/fields/product_fields.hpp"

namespace sixstep::design {

template <class Walk, class Kept>
void fields(Walk&& w, const control::ZeroCrossingConfig& d, Kept& kept) {
  auto& [seen, rail_counts, threshold, below, margin_ticks, settle_ticks] = kept;
  constexpr control::ZeroCrossingConfig unset{};
  w.choice({"seen"}, d.seen, seen, unset.seen);
  w.count({"rail_counts"}, d.rail_counts, rail_counts, unset.rail_counts);
  w.count({"threshold", "", "counts of y"}, d.threshold, threshold, unset.threshold);
  w.count({"below", "", "counts of y"}, d.below, below, unset.below);
  w.count({"margin_ticks", "", "timer ticks"}, d.margin_ticks, margin_ticks, unset.margin_ticks);
  w.count({"settle_ticks", "", "timer ticks"}, d.settle_ticks, settle_ticks, unset.settle_ticks);
}

template <class Walk, class Kept>
void fields(Walk&& w, const control::CapturedCrossingConfig& d, Kept& kept) {
  auto& [follows, lag_ticks, period_ticks, settle_ticks] = kept;
  constexpr control::CapturedCrossingConfig unset{};
  w.flag({"follows"}, d.follows, follows);
  w.count({"lag_ticks", "", "timer ticks"}, d.lag_ticks, lag_ticks, unset.lag_ticks);
  w.count({"period_ticks", "", "timer ticks"}, d.period_ticks, period_ticks, unset.period_ticks);
  w.count({"settle_ticks", "", "timer ticks"}, d.settle_ticks, settle_ticks, unset.settle_ticks);
}

template <class Walk, class Kept>
void fields(Walk&& w, const control::CommutationClockConfig& d, Kept& kept) {
  auto& [crossings, advance, lead_ticks] = kept;
  constexpr control::CommutationClockConfig unset{};
  w.count({"crossings"}, d.crossings, crossings, unset.crossings);
  w.count({"advance", "", "of a sector's 65536 parts"}, d.advance, advance, unset.advance);
  w.count({"lead_ticks", "", "timer ticks"}, d.lead_ticks, lead_ticks, unset.lead_ticks);
}

template <class Walk, class Kept>
void fields(Walk&& w, const control::SpinConfig& d, Kept& kept) {
  auto& [threshold, crossings, settle_ticks, listen_ticks] = kept;
  constexpr control::SpinConfig unset{};
  w.count({"threshold", "", "counts of 3 e"}, d.threshold, threshold, unset.threshold);
  w.count({"crossings"}, d.crossings, crossings, unset.crossings);
  w.count({"settle_ticks", "", "timer ticks"}, d.settle_ticks, settle_ticks, unset.settle_ticks);
  w.count({"listen_ticks", "", "timer ticks"}, d.listen_ticks, listen_ticks, unset.listen_ticks);
}

template <class Walk, class Kept>
void fields(Walk&& w, const control::LockConfig& d, Kept& kept) {
  auto& [window_eighths, tolerated, unlike_samples, shortest_ticks, longest_ticks, most_flux, threshold,
         retries, sectors_to_forget] = kept;
  constexpr control::LockConfig unset{};
  w.count({"window_eighths"}, d.window_eighths, window_eighths, unset.window_eighths);
  w.count({"tolerated"}, d.tolerated, tolerated, unset.tolerated);
  w.count({"unlike_samples"}, d.unlike_samples, unlike_samples, unset.unlike_samples);
  w.count({"shortest_ticks", "", "timer ticks of a sector"}, d.shortest_ticks, shortest_ticks,
          unset.shortest_ticks);
  w.count({"longest_ticks", "", "timer ticks of a sector"}, d.longest_ticks, longest_ticks,
          unset.longest_ticks);
  w.count({"most_flux", "", "counts of y times ticks"}, d.most_flux, most_flux, unset.most_flux);
  w.count({"threshold", "", "counts of y"}, d.threshold, threshold, unset.threshold);
  w.count({"retries"}, d.retries, retries, unset.retries);
  w.count({"sectors_to_forget"}, d.sectors_to_forget, sectors_to_forget, unset.sectors_to_forget);
}

template <class Walk, class Kept>
void fields(Walk&& w, const control::PositionSourceConfig& d, Kept& kept) {
  auto& [has_hall, wanted, falls_back, agreed, hall] = kept;
  constexpr control::PositionSourceConfig unset{};
  w.flag({"has_hall"}, d.has_hall, has_hall);
  w.choice({"wanted"}, d.wanted, wanted, unset.wanted);
  w.count({"falls_back"}, d.falls_back, falls_back, unset.falls_back);
  w.count({"agreed"}, d.agreed, agreed, unset.agreed);
  w.part("hall", d.hall, hall);
}

template <class Walk, class Kept>
void fields(Walk&& w, const control::StartUpConfig<double>& d, Kept& kept) {
  auto& [current_A, falling_A, align_ticks, swing_shift, swing_threshold, first_speed, acceleration, jerk,
         last_speed, longest_ticks, trusted, trusted_ticks] = kept;
  w.signal({"current_A", "A"}, d.current_A, current_A, Base::current);
  w.signal({"falling_A", "A"}, d.falling_A, falling_A, Base::current);
  constexpr control::StartUpConfig<double> unset{};
  w.count({"align_ticks", "", "timer ticks"}, d.align_ticks, align_ticks, unset.align_ticks);
  w.count({"swing_shift"}, d.swing_shift, swing_shift, unset.swing_shift);
  w.count({"swing_threshold", "", "counts of y"}, d.swing_threshold, swing_threshold, unset.swing_threshold);
  w.count({"first_speed", "", "2^-32 sectors per tick"}, d.first_speed, first_speed, unset.first_speed);
  w.count({"acceleration", "", "2^-32 sectors per tick^2"}, d.acceleration, acceleration, unset.acceleration);
  w.count({"jerk", "", "2^-48 sectors per tick^3"}, d.jerk, jerk, unset.jerk);
  w.count({"last_speed", "", "2^-32 sectors per tick"}, d.last_speed, last_speed, unset.last_speed);
  w.count({"longest_ticks", "", "timer ticks"}, d.longest_ticks, longest_ticks, unset.longest_ticks);
  w.count({"trusted", "", "crossings"}, d.trusted, trusted, unset.trusted);
  w.count({"trusted_ticks", "", "timer ticks"}, d.trusted_ticks, trusted_ticks, unset.trusted_ticks);
}

template <class Walk, class Kept>
void fields(Walk&& w, const control::SensorlessConfig<double>& d, Kept& kept, bool measures_position) {
  auto& [crossing, captured, clock, spin, start, lock, speed, position] = kept;
  w.part("crossing", d.crossing, crossing);
  w.part("captured", d.captured, captured);
  w.part("clock", d.clock, clock);
  w.part("spin", d.spin, spin);
  w.part("lock", d.lock, lock);
  w.part("start", d.start, start);
  w.part("speed", d.speed, speed);
  if (w.when_run(measures_position)) w.part("position", d.position, position);
}

/// Lists all fields except the members `drive`, which has its own list, and `observer`
/// (observer_scaling.hpp).
template <class Walk, class Kept>
void fields(Walk&& w, const control::SensorlessDriveConfig<double>& d, Kept& kept) {
  auto& [drive, sensorless, source, observer, start_output, duty, current, least_duty] = kept;
  w.part("source", d.source, source);
  w.part("sensorless", d.sensorless, sensorless, d.drive.mode == control::Mode::position);
  w.signal({"start_output", "of full torque"}, d.start_output, start_output, Base::one);
  w.sum({"duty.step", "", "per tick"}, d.duty.step, duty.step, Base::one);
  w.sum({"current.step", "A", "per tick"}, d.current.step, current.step, Base::current);
  w.signal({"least_duty"}, d.least_duty, least_duty, Base::one);
}

/// Lists the fields of a converter. Its numbers are the same in every arithmetic.
template <class Walk, class Kept>
void fields(Walk&& w, const control::AdcConfig<control::Q30>& d, Kept& kept) {
  auto& [per_eighth, offset_counts, offset_tolerance, log2_samples] = kept;
  constexpr control::AdcConfig<control::Q30> unset{};
  w.count({"per_eighth"}, d.per_eighth, per_eighth, unset.per_eighth);
  w.count({"offset_counts"}, d.offset_counts, offset_counts, unset.offset_counts);
  w.count({"offset_tolerance", "", "counts"}, d.offset_tolerance, offset_tolerance, unset.offset_tolerance);
  w.count({"log2_samples"}, d.log2_samples, log2_samples, unset.log2_samples);
}

template <class Walk, class Kept>
void fields(Walk&& w, const control::PulsePositionConfig& d, Kept& kept) {
  auto& [current, pulse_ticks, rest_ticks, rounds, certain, amplifiers] = kept;
  constexpr control::PulsePositionConfig unset{};
  w.part("current", d.current, current);
  w.count({"pulse_ticks", "", "control periods"}, d.pulse_ticks, pulse_ticks, unset.pulse_ticks);
  w.count({"rest_ticks", "", "control periods"}, d.rest_ticks, rest_ticks, unset.rest_ticks);
  w.count({"rounds"}, d.rounds, rounds, unset.rounds);
  w.count({"certain"}, d.certain, certain, unset.certain);
  w.count({"amplifiers", "", "parts of 1000"}, d.amplifiers, amplifiers, unset.amplifiers);
}

}  // namespace sixstep::design

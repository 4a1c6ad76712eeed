// SPDX-License-Identifier: Apache-2.0
// Lists every field of a back-EMF observer's configuration (control/sensorless/observer.hpp) once, for
// export. The conversion to a chip's numbers is separate (scaling/observer_scaling.hpp), because the observer
// uses the converter's counts as well as the drive's units. Each list binds all members of its struct: the
// list does not compile if a member is missing.
#pragma once
#include "sixstep/control/sensorless/observer.hpp"
#include "sixstep/design/fields/field.hpp"

namespace sixstep::design {

inline constexpr Ratio plain{Base::one, Base::one}, amperes_per_volt{Base::current, Base::voltage},
    volts_per_ampere{Base::voltage, Base::current};

template <class Walk, class Kept>
void fields(Walk&& w, const control::FloatingVoltageConfig<double>& c, Kept& kept) {
  auto& [third_per_count, rail_counts, through_freewheel] = kept;
  constexpr control::FloatingVoltageConfig<double> unset{};
  w.raw_gain({"third_per_count", "V", "per count and third"}, c.third_per_count, third_per_count,
             Base::voltage);
  w.count({"rail_counts"}, c.rail_counts, rail_counts, unset.rail_counts);
  w.flag({"through_freewheel"}, c.through_freewheel, through_freewheel);
}

template <class Walk, class Kept>
void fields(Walk&& w, const control::LuenbergerConfig<double>& c, Kept& kept) {
  auto& [decay, drive, current, emf] = kept;
  w.gain({"decay", "", "exp(-R T/L)"}, c.decay, decay, plain);
  w.gain({"drive", "A per V"}, c.drive, drive, amperes_per_volt);
  w.gain({"current"}, c.current, current, plain);
  w.gain({"emf", "V per A"}, c.emf, emf, volts_per_ampere);
}

template <class Walk, class Kept>
void fields(Walk&& w, const control::SlidingModeConfig<double>& c, Kept& kept) {
  auto& [decay, drive, slope, limit_V, raise, share] = kept;
  w.gain({"decay", "", "exp(-R T/L)"}, c.decay, decay, plain);
  w.gain({"drive", "A per V"}, c.drive, drive, amperes_per_volt);
  w.gain({"slope", "V per A"}, c.slope, slope, volts_per_ampere);
  w.signal({"limit_V", "V"}, c.limit_V, limit_V, Base::voltage);
  w.gain({"raise"}, c.raise, raise, plain);
  w.gain({"share"}, c.share, share, plain);
}

template <class Walk, class Kept>
void fields(Walk&& w, const control::FluxLinkageConfig<double>& c, Kept& kept) {
  auto& [decay, stiffness, per_V, level] = kept;
  w.gain({"decay", "", "exp(-R T/L)"}, c.decay, decay, plain);
  w.gain({"stiffness", "V per A"}, c.stiffness, stiffness, volts_per_ampere);
  w.gain({"per_V", "1/V"}, c.per_V, per_V, {Base::one, Base::voltage});
  w.signal({"level"}, c.level, level, Base::one);
}

template <class Walk, class Kept>
void fields(Walk&& w, const control::ObserverConfig<double>& c, Kept& kept) {
  auto& [follow, voltage, luenberger, sliding_mode, flux, counts_per_V, lag_ticks] = kept;
  constexpr control::ObserverConfig<double> unset{};
  w.choice({"follow"}, c.follow, follow, control::Follow::crossings);
  w.part("voltage", c.voltage, voltage);
  w.part("luenberger", c.luenberger, luenberger);
  w.part("sliding_mode", c.sliding_mode, sliding_mode);
  w.part("flux", c.flux, flux);
  w.gain_of_raw({"counts_per_V", "counts per V", "three times the converter's"}, c.counts_per_V, counts_per_V,
                Base::voltage);
  w.count({"lag_ticks", "", "of the timer"}, c.lag_ticks, lag_ticks, unset.lag_ticks);
}

}  // namespace sixstep::design

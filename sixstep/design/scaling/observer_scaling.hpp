// SPDX-License-Identifier: Apache-2.0
// Converts the configuration of a back-EMF observer to the chip's number format.
#pragma once
#include "sixstep/control/sensorless/observer.hpp"
#include "sixstep/design/scaling/scaling.hpp"

namespace sixstep::design {

/// The configuration in numbers of type Scalar. In floating point every base is 1.
template <class Scalar>
control::ObserverConfig<Scalar> observer_in(const control::ObserverConfig<double>& d, const Bases& b) {
  double digit = 1.0, volt = 1.0, ampere = 1.0;
  if constexpr (requires { Scalar::fraction_bits; }) {
    digit = static_cast<double>(Scalar::from_raw(1));
    volt = b.voltage_V;
    ampere = b.current_A;
  }
  const auto gain = [](double x) { return static_cast<control::Gain<Scalar>>(x); };
  const double A_per_V = volt / ampere, V_per_A = ampere / volt;
  control::ObserverConfig<Scalar> c;
  c.follow = d.follow;
  c.voltage = {gain(d.voltage.third_per_count / volt / digit), d.voltage.rail_counts,
               d.voltage.through_freewheel};
  c.luenberger = {gain(d.luenberger.decay), gain(d.luenberger.drive * A_per_V), gain(d.luenberger.current),
                  gain(d.luenberger.emf * V_per_A)};
  const control::SlidingModeConfig<double>& s = d.sliding_mode;
  c.sliding_mode = {gain(s.decay),           gain(s.drive * A_per_V),
                    gain(s.slope * V_per_A), static_cast<Scalar>(s.limit_V / volt),
                    gain(s.raise),           gain(s.share)};
  c.flux = {gain(d.flux.decay), gain(d.flux.stiffness * V_per_A), gain(d.flux.per_V * volt),
            static_cast<Scalar>(d.flux.level)};
  c.counts_per_V = gain(d.counts_per_V * volt * digit);
  c.lag_ticks = d.lag_ticks;
  return c;
}

}  // namespace sixstep::design

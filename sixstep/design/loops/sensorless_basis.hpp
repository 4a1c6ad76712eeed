// SPDX-License-Identifier: Apache-2.0
// What a sensorless drive's numbers are made of, and what a motor and a board leave out of reach of one (sensorless_start.hpp has
// the rules).
#pragma once
#include "sixstep/base/angle.hpp"
#include "sixstep/design/loops/sensorless_start.hpp"

namespace sixstep::design {

inline constexpr double rail_lags = 3.5;  ///< from an edge until a terminal is at its rail, to exp(-3.5)

/// In SI.
struct SensorlessBasis {
  const MotorModel& motor;
  const SensorlessSpec& spec;
  double R_tt = 0.0, no_load_rad_s = 0.0, nominal_A = 0.0, start_A = 0.0, load_Nm = 0.0;
  double lsb_V = 0.0, threshold_V = 0.0, lowest_rad_s = 0.0;
  double lock_V = 0.0;            ///< the threshold with what comparators are off by
  double lag_s = 0.0;             ///< of the terminals' filters
  double comparator_lag_s = 0.0;  ///< of those in front of comparators that are followed

  double sector_s(double speed_rad_s) const {
    return base::sector_rad / (motor.machine.pole_pairs * speed_rad_s);
  }
  double counts(double seconds) const { return seconds * spec.capture_Hz; }
  double settle_s() const { return rail_lags * lag_s; }
  /// On-time of a rotor that turns at the lowest speed without a load.
  double least_on_s() const {
    const double part = lowest_rad_s / no_load_rad_s;
    return (spec.chopping == control::Chopping::hard ? (1.0 + part) / 2.0 : part) * spec.period_s;
  }
  double ramp_rad_s2() const;               ///< that the ramp asks for
  double ramp_A() const;                    ///< what the ramp takes as it ends
  double swing_s() const;                   ///< a period of the rotor about where it is aligned
  double comparators_V() const;             ///< how far from nothing y may be where their line turns over
  double longest_comparator_lag_s() const;  ///< time constant of their low-pass, at most
};

/// Numbers that no drive can be made of.
base::Problems unusable(const MotorModel& motor, const SensorlessSpec& spec);

/// Of numbers that can be used; motor and spec have to outlive it.
SensorlessBasis sensorless_basis(const MotorModel& motor, const SensorlessSpec& spec);

/// What a drive could not do with such a load, converter, filter or comparators: one problem, or none.
base::Problems out_of_reach(const SensorlessBasis& b);

}  // namespace sixstep::design

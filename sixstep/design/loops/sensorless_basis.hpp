// SPDX-License-Identifier: Apache-2.0
// Computes the basic values of a sensorless drive, and finds what motor and board make impossible
// (sensorless_start.hpp has the rules).
#pragma once
#include "sixstep/base/angle.hpp"
#include "sixstep/design/loops/sensorless_start.hpp"

namespace sixstep::design {

inline constexpr double rail_lags = 3.5;  ///< lags after which a terminal is within exp(-3.5) of its rail

/// Basic values, SI.
struct SensorlessBasis {
  const MotorModel& motor;
  const SensorlessSpec& spec;
  double R_tt = 0.0, no_load_rad_s = 0.0, nominal_A = 0.0, start_A = 0.0, load_Nm = 0.0;
  double lsb_V = 0.0, threshold_V = 0.0, lowest_rad_s = 0.0;
  double lock_V = 0.0;            ///< the threshold plus the comparators' error
  double lag_s = 0.0;             ///< lag of the terminals' filters
  double comparator_lag_s = 0.0;  ///< lag of the low-passes before the comparators, if these are followed

  double sector_s(double speed_rad_s) const {
    return base::sector_rad / (motor.machine.pole_pairs * speed_rad_s);
  }
  double counts(double seconds) const { return seconds * spec.capture_Hz; }
  double settle_s() const { return rail_lags * lag_s; }
  /// On-time at the lowest speed without a load.
  double least_on_s() const {
    const double part = lowest_rad_s / no_load_rad_s;
    return (spec.chopping == control::Chopping::hard ? (1.0 + part) / 2.0 : part) * spec.period_s;
  }
  double ramp_rad_s2() const;               ///< acceleration of the ramp
  double ramp_A() const;                    ///< current at the end of the ramp
  double swing_s() const;                   ///< period of the rotor's swing about its alignment
  double comparators_V() const;             ///< largest |y| at which a comparator's line may change
  double longest_comparator_lag_s() const;  ///< upper bound of their low-pass's time constant
};

/// Problems of values that no drive can use.
base::Problems unusable(const MotorModel& motor, const SensorlessSpec& spec);

/// For usable values. motor and spec must outlive the result.
SensorlessBasis sensorless_basis(const MotorModel& motor, const SensorlessSpec& spec);

/// Problem of a load, converter, filter or comparators that a drive could not work with: one, or none.
base::Problems out_of_reach(const SensorlessBasis& b);

}  // namespace sixstep::design

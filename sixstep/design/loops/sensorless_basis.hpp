// SPDX-License-Identifier: Apache-2.0
// Computes the basic values of a sensorless drive, and finds limits of a motor and a board (the rules are in
// sensorless_start.hpp).
#pragma once
#include "sixstep/base/angle.hpp"
#include "sixstep/design/loops/sensorless_start.hpp"

namespace sixstep::design {

inline constexpr double rail_lags = 3.5;  ///< number of lags after which a terminal's distance to its rail is
                                          ///< exp(-3.5) of the bus

/// Basic values of the design, in SI units.
struct SensorlessBasis {
  const MotorModel& motor;
  const SensorlessSpec& spec;
  double R_tt = 0.0, no_load_rad_s = 0.0, nominal_A = 0.0, start_A = 0.0, load_Nm = 0.0;
  double lsb_V = 0.0, threshold_V = 0.0, lowest_rad_s = 0.0;
  double lock_V = 0.0;            ///< threshold_V plus the comparators' error
  double lag_s = 0.0;             ///< lag of the terminals' filters
  double comparator_lag_s = 0.0;  ///< lag of the comparators' low-passes if comparators are followed

  double sector_s(double speed_rad_s) const {
    return base::sector_rad / (motor.machine.pole_pairs * speed_rad_s);
  }
  double counts(double seconds) const { return seconds * spec.capture_Hz; }
  double settle_s() const { return rail_lags * lag_s; }
  /// On-time at the lowest speed without a load, s.
  double least_on_s() const {
    const double part = lowest_rad_s / no_load_rad_s;
    return (spec.chopping == control::Chopping::hard ? (1.0 + part) / 2.0 : part) * spec.period_s;
  }
  double ramp_rad_s2() const;               ///< acceleration of the ramp
  double ramp_A() const;                    ///< current at the end of the ramp
  double swing_s() const;                   ///< period of the rotor's swing about its alignment
  double comparators_V() const;             ///< largest |y| at which a comparator's line may change
  double longest_comparator_lag_s() const;  ///< upper bound of the time constant of the comparators'
                                            ///< low-pass, s
};

/// Problems of values that no sensorless drive can use.
base::Problems unusable(const MotorModel& motor, const SensorlessSpec& spec);

/// The basic values, if unusable() finds no problem. motor and spec must outlive the result.
SensorlessBasis sensorless_basis(const MotorModel& motor, const SensorlessSpec& spec);

/// Problem of a load, a converter, a filter or comparators that exclude sensorless operation: at most one.
base::Problems out_of_reach(const SensorlessBasis& b);

}  // namespace sixstep::design

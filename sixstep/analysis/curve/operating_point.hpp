// SPDX-License-Identifier: Apache-2.0
// Computes one point of the torque-speed curve: the steady state of motor and bridge at a constant speed.
//
// Any start decays. Two runs at the same speed and gates differ by d with L d|d|^2/dt <= -2 R |d|^2, because the
// back-EMF cancels, and switches and diodes are resistors or valves, which only take energy from a difference. So
// there is one steady state, and any run comes closer to it by at least q = exp(-R_s t/L_s) within t.
//   duty 1     the steady state repeats every sector, with phases exchanged: it is the fixed point of the map from one
//              sector start to the next. Applying the map shrinks the distance by q; after a step of size r,
//              at most q/(1 - q) r remains (Banach), which is the point's error bound.
//   chopped    PWM and rotor are out of step, so that the orbit never quite repeats: mean values over batches that
//              start in different phases, with a confidence interval from their scatter.
//   standstill the limit of slow rotation: without back-EMF the current does not depend on the angle, so that the
//              mean over all angles has a closed form. LockedRotor has the values of a rotor held at one angle.
#pragma once
#include <cstdint>
#include <optional>

#include "sixstep/analysis/curve/bench.hpp"
#include "sixstep/base/result.hpp"

namespace sixstep::analysis {

enum class Orbit : std::uint8_t { standstill, periodic, quasi_periodic };

/// A rotor held at one angle: two phases carry all of the current, and the angle decides the torque.
struct LockedRotor {
  double phase_rms_A = 0.0;                                ///< rms current of each of the two phases
  double least_torque_Nm = 0.0, greatest_torque_Nm = 0.0;  ///< by size, over all angles
  double ripple_Nm = 0.0;  ///< within a PWM period where the torque is least, peak to peak
};

/// Mean values over the orbit; powers positive as a motor: supplied = copper + devices + air gap, air gap =
/// friction + shaft.
struct OperatingPoint {
  double speed_rad_s = 0.0;
  double torque_Nm = 0.0;        ///< electromagnetic, mean of T_e
  double shaft_torque_Nm = 0.0;  ///< less friction
  double ripple_Nm = 0.0;        ///< ripple of T_e, peak to peak
  double ripple_rms_Nm = 0.0;    ///< rms of T_e about its mean
  double bus_current_A = 0.0;
  double winding_current_A = 0.0;  ///< mean of (|i_a| + |i_b| + |i_c|)/2
  double motor_current_A = 0.0;    ///< mean of |i_m|, i_m = (i_p - i_n)/2 of the positive pair (model.md 3)
  double phase_rms_A = 0.0, phase_peak_A = 0.0;
  double supplied_W = 0.0, copper_W = 0.0, devices_W = 0.0, friction_W = 0.0, shaft_W = 0.0;
  /// Shaft power over supply as a motor, supply over shaft as a generator; empty otherwise.
  std::optional<double> efficiency;
  double energy_residual = 0.0;  ///< supplied - copper - devices - air gap - stored, over the largest energy

  std::optional<LockedRotor> locked;  ///< at standstill

  Orbit orbit = Orbit::standstill;
  std::int64_t sectors = 0;    ///< simulated
  double residual_A = 0.0;     ///< periodic: distance between the currents one sector apart
  double error_bound_A = 0.0;  ///< periodic: bound of the currents' distance to the steady state
  double half_width_Nm =
      0.0;                    ///< quasi-periodic: half width of the mean torque's interval (confidence_level)
  double half_width_A = 0.0;  ///< quasi-periodic: half width of the mean bus current's interval
  double simulated_s = 0.0;   ///< averaging time of the mean values
  /// Quasi-periodic: the interval is below half_width_goal of the stall torque. Periodic: the currents repeat to
  /// rounding.
  bool precise = true;
};

/// Batch means: `batches` runs differ in the phase of the PWM period at which the rotor passes one angle; the
/// phases are spread evenly. Each run, once its start has decayed, is averaged from that angle on over the same
/// whole number of sectors. Their scatter gives Student's interval at this level for the mean over all
/// phases. One long run would reach all phases by itself, but arbitrarily slowly where PWM and sectors are
/// nearly in step, and its own batches would not show this. While the torque's half width is above
/// half_width_goal K_t |d| U/R_tt, all runs go on for as long again, at most `doublings` times. PWM and
/// sectors in step show as an interval that stays wide.
inline constexpr double confidence_level = 0.99;
inline constexpr int batches = 20, doublings = 8;
inline constexpr double half_width_goal = 5e-5;

/// Problems: those of check(bench), a speed that is not finite, or a run that could not go on (a defect).
base::Result<OperatingPoint> operating_point(const Bench& bench, double speed_rad_s);

}  // namespace sixstep::analysis

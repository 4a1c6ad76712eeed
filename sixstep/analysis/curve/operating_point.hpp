// SPDX-License-Identifier: Apache-2.0
// One point of the torque-speed curve: the steady state of motor and bridge at a speed that the bench holds.
//
// The currents forget. Two runs at the same speed and gates differ by d with L d|d|^2/dt <= -2 R |d|^2: the
// back-EMF cancels, switches and diodes are resistors or valves, which only take energy from a difference. So
// there is one steady state, and any run comes closer to it by at least q = exp(-R_s t/L_s) within t.
//   duty 1     it repeats every sector, phases exchanged: the fixed point of the map from one sector start to
//              the next. Applying the map shrinks the distance by q; after a step of size r what is left is
//              at most q/(1 - q) r (Banach), which the point carries as its error bound.
//   chopped    PWM and rotor are out of step, the orbit never quite repeats: mean values over batches that
//              start in different phases, with a confidence interval from their scatter.
//   standstill the limit of slow rotation: without back-EMF the current does not depend on the angle, so that
//              the mean over all angles is closed form. What a rotor that does not turn at all makes of the
//              same current at one angle stands beside it.
#pragma once
#include <cstdint>
#include <optional>

#include "sixstep/analysis/curve/bench.hpp"
#include "sixstep/base/result.hpp"

namespace sixstep::analysis {

enum class Orbit : std::uint8_t { standstill, periodic, quasi_periodic };

/// Held at one angle: two phases carry all of the current, the third none, and the angle decides the torque.
struct LockedRotor {
  double phase_rms_A = 0.0;                                ///< of each of the two
  double least_torque_Nm = 0.0, greatest_torque_Nm = 0.0;  ///< by size, of all angles
  double ripple_Nm = 0.0;  ///< within a PWM period where the torque is least, peak to peak
};

/// Mean values over the orbit; powers positive as a motor: supplied = copper + devices + air gap, air gap =
/// friction + shaft.
struct OperatingPoint {
  double speed_rad_s = 0.0;
  double torque_Nm = 0.0;        ///< electromagnetic, mean of T_e
  double shaft_torque_Nm = 0.0;  ///< less friction
  double ripple_Nm = 0.0;        ///< of T_e, peak to peak
  double ripple_rms_Nm = 0.0;    ///< of T_e about its mean
  double bus_current_A = 0.0;
  double winding_current_A = 0.0;  ///< mean of (|i_a| + |i_b| + |i_c|)/2: what flows through the winding
  double motor_current_A = 0.0;    ///< mean of |i_m|, i_m = (i_p - i_n)/2 of the positive pair (model.md 3)
  double phase_rms_A = 0.0, phase_peak_A = 0.0;
  double supplied_W = 0.0, copper_W = 0.0, devices_W = 0.0, friction_W = 0.0, shaft_W = 0.0;
  /// Shaft over supply as a motor, supply over shaft as a generator; empty where one of them is no source.
  std::optional<double> efficiency;
  double energy_residual = 0.0;  ///< supplied - copper - devices - air gap - stored, over what moved

  std::optional<LockedRotor> locked;  ///< at standstill

  Orbit orbit = Orbit::standstill;
  std::int64_t sectors = 0;    ///< simulated
  double residual_A = 0.0;     ///< periodic: distance of the currents one sector apart
  double error_bound_A = 0.0;  ///< periodic: of the currents to the steady state
  double half_width_Nm = 0.0;  ///< quasi-periodic: of the mean torque's interval (confidence_level)
  double half_width_A = 0.0;   ///< quasi-periodic: of the mean bus current's
  double simulated_s = 0.0;    ///< what the mean values are taken over
  /// Quasi-periodic: the interval came below half_width_goal of the stall torque. Periodic: the currents
  /// repeat to rounding.
  bool precise = true;
};

/// Batch means: `batches` runs that differ in how far a PWM period has come when the rotor passes one angle,
/// phases spread evenly; each, once its start is forgotten, from that angle on over the same whole number of
/// sectors. Their scatter gives
/// Student's interval at this level for the mean over all phases. One long run instead would go through the
/// phases by itself, but arbitrarily slowly where PWM and sectors are nearly in step, and its own batches
/// would not tell. As long as the torque's half width is above half_width_goal K_t |d| U/R_tt all run on for
/// as long again, at most `doublings` times; that PWM and sectors are in step shows as an interval that stays
/// wide.
inline constexpr double confidence_level = 0.99;
inline constexpr int batches = 20, doublings = 8;
inline constexpr double half_width_goal = 5e-5;

/// Problems: those of check(bench), a speed that is not finite, or a run that could not go on (a defect).
base::Result<OperatingPoint> operating_point(const Bench& bench, double speed_rad_s);

}  // namespace sixstep::analysis

// SPDX-License-Identifier: Apache-2.0
// Computes one point of the torque-speed curve: the steady state of motor and bridge at a constant speed.
//
// The effect of the initial state decays. Two runs at the same speed and gates differ by the currents d with
// L_s d|d|^2/dt <= -2 R_s |d|^2; L_s, R_s: inductance and resistance of a phase. The back-EMF cancels, and
// switches and diodes are resistors or valves, which only dissipate. Therefore there is one steady state.
// Within the time t, any run reduces its distance to this state at least by the factor q = exp(-R_s t/L_s).
// - Duty 1: the steady state repeats every sector, with phases exchanged. It is the fixed point of the map
//   from one sector start to the next. Each application of the map reduces the distance by q. After a step of
//   size r, the distance is at most q/(1 - q) r (Banach), which is the point's error bound.
// - Chopped: PWM and rotor are not synchronous; the currents never repeat exactly. The point's values are
//   means over batches that start at different phases, with a confidence interval from their scatter.
// - Standstill: the limit of slow rotation. Without back-EMF the current does not depend on the angle; the
//   mean over all angles therefore has a closed form. LockedRotor contains the values of a rotor held at one
//   angle.
#pragma once
#include <cstdint>
#include <optional>

#include "sixstep/analysis/curve/bench.hpp"
#include "sixstep/base/result.hpp"

namespace sixstep::analysis {

enum class Orbit : std::uint8_t { standstill, periodic, quasi_periodic };

/// A rotor held at one angle: two phases carry all of the current, and the torque depends on the angle.
struct LockedRotor {
  double phase_rms_A = 0.0;                                ///< rms current of each of the two phases
  double least_torque_Nm = 0.0, greatest_torque_Nm = 0.0;  ///< least and greatest magnitude over all angles
  double ripple_Nm = 0.0;  ///< torque ripple within a PWM period, peak to peak, at the angle of least torque
};

/// Mean values over the steady state. Powers are positive for a motor: supplied = copper + devices + air gap,
/// and air gap = friction + shaft.
struct OperatingPoint {
  double speed_rad_s = 0.0;
  double torque_Nm = 0.0;        ///< electromagnetic, mean of T_e
  double shaft_torque_Nm = 0.0;  ///< torque_Nm less friction
  double ripple_Nm = 0.0;        ///< ripple of T_e, peak to peak
  double ripple_rms_Nm = 0.0;    ///< rms of T_e about its mean
  double bus_current_A = 0.0;
  double winding_current_A = 0.0;  ///< mean of (|i_a| + |i_b| + |i_c|)/2
  double motor_current_A = 0.0;    ///< mean of |i_m|, i_m = (i_p - i_n)/2 of the positive pair (model.md 3)
  double phase_rms_A = 0.0, phase_peak_A = 0.0;
  double supplied_W = 0.0, copper_W = 0.0, devices_W = 0.0, friction_W = 0.0, shaft_W = 0.0;
  /// Motor: shaft power divided by supplied power. Generator: supplied power divided by shaft power.
  /// Otherwise empty.
  std::optional<double> efficiency;
  double energy_residual = 0.0;  ///< (supplied - copper - devices - air gap - stored)/largest of these
                                 ///< energies

  std::optional<LockedRotor> locked;  ///< only at standstill

  Orbit orbit = Orbit::standstill;
  std::int64_t sectors = 0;    ///< number of simulated sectors
  double residual_A = 0.0;     ///< at duty 1: distance between the currents one sector apart
  double error_bound_A = 0.0;  ///< at duty 1: bound of the currents' distance to the steady state
  double half_width_Nm = 0.0;  ///< chopped: half width of the mean torque's interval (confidence_level)
  double half_width_A = 0.0;   ///< chopped: half width of the mean bus current's interval
  double simulated_s = 0.0;    ///< averaging time of the mean values
  /// True: with chopping, the interval is narrower than half_width_goal of the stall torque; at duty 1, the
  /// currents repeat except for rounding.
  bool precise = true;
};

/// Batch means: `batches` runs differ in the phase of the PWM period at which the rotor passes one angle. The
/// phases are spread evenly. After its initial deviation has decayed, each run is averaged from this angle on
/// over the same whole number of sectors. The scatter of the averages gives Student's interval at this level
/// for the mean over all phases.
///
/// A single long run would also reach all phases, but arbitrarily slowly if PWM and sectors are nearly
/// synchronous. Batches within this run would not show the error.
///
/// While the torque's half width is above half_width_goal times the stall torque K_t |d| U/R_tt, all runs are
/// continued by their present length, at most `doublings` times. If PWM and sectors are synchronous, the
/// interval stays wide.
inline constexpr double confidence_level = 0.99;
inline constexpr int batches = 20, doublings = 8;
inline constexpr double half_width_goal = 5e-5;

/// Problems of check(bench), a speed that is not finite, or a run that could not continue (a defect).
base::Result<OperatingPoint> operating_point(const Bench& bench, double speed_rad_s);

}  // namespace sixstep::analysis

// SPDX-License-Identifier: Apache-2.0
// Computes the limits of bus, modulation and motor that do not depend on the gains: ripple, headroom over speed,
// braking.
#pragma once
#include "sixstep/control/bridge_command.hpp"
#include "sixstep/design/sheet/parameters.hpp"

namespace sixstep::design {

/// Change of the pair's mean voltage u per duty d, relative to the bus voltage U, with continuous current. If
/// one switch of the pair stays on, the pair has 0 V in the off state and u = d U: the result is 1 (soft and
/// complementary). If both switches are off, the current flows against the bus and u = d U - (1 - d) U: the
/// result is 2 (hard).
double volts_per_duty(control::Chopping chopping);
/// The duty at which the pair's mean voltage is the fraction `part_of_bus` of the bus.
double duty_for_voltage(control::Chopping chopping, double part_of_bus);

/// Ripple of the driven pair's current, A peak to peak, in steady chopping at a duty, with continuous current
/// and ideal switches. The pair has U_on for d T and U_off for (1 - d) T:
///   (U_on - U_off)/R (1 - exp(-d x)) (1 - exp(-(1 - d) x))/(1 - exp(-x)),   x = R T/L.
/// The ripple does not depend on the back-EMF. U_on - U_off = volts_per_duty() U_s.
double current_ripple_A(const MotorModel& motor, double bus_V, double period_s, control::Chopping chopping,
                        double duty);

/// Ripple, A peak to peak, if the pair switches between on_V and off_V and the mean over a period is mean_V;
/// 0 if mean_V is not between them.
double ripple_between_A(const MotorModel& motor, double on_V, double off_V, double mean_V, double period_s);

struct Ripple {
  double worst_A = 0.0;  ///< peak to peak, at worst_duty = 0.5
  double worst_duty = 0.5;
  double continuous_above_A =
      0.0;  ///< half of worst_A: a soft-chopped current with a smaller mean is discontinuous
};
Ripple worst_ripple(const MotorModel& motor, double bus_V, double period_s, control::Chopping chopping);

/// Period at which the worst ripple is `ripple_A`, s; infinite if the ripple is smaller for every period.
double period_for_ripple_s(const MotorModel& motor, double bus_V, control::Chopping chopping,
                           double ripple_A);

/// Nominal current of a motor. If the sheet does not have it, A is a tenth of the stall current and `printed`
/// is false; every output of the number must show this.
struct NominalCurrent {
  double A = 0.0;
  bool printed = true;
};
NominalCurrent nominal_current(const MotorModel& motor, double bus_V);

/// Default torque limit of a drive: the torque of 2.5 times the nominal current, which a winding carries for
/// seconds (2 to 3 is usual). It is at most the torque of the stall current on this bus.
inline constexpr double usual_overload = 2.5;
double usual_torque_limit_Nm(const MotorModel& motor, double bus_V);

/// Remaining voltage of the bus for changing the current i at speed w, V: U_s - R_tt i - K_t w. If it is
/// negative, i cannot flow.
double headroom_V(const MotorModel& motor, double bus_V, double current_A, double speed_rad_s);
/// Speed at which headroom_V() is 0 for this current.
double speed_for_current_rad_s(const MotorModel& motor, double bus_V, double current_A);

/// A high speed, as a fraction of the highest speed at nominal current. The remaining voltage at this speed
/// is for control.
inline constexpr double high_speed_part = 0.9;

/// Loss of speed by commutations at a current, relative to the remaining speed. In each sector, of duration
/// pi/(3 p w), the entering phase takes over the current. This reduces the volt seconds of the bus by L_s i,
/// with L_s of a phase: the result is 3 p L_s i/(pi K_t). Simulated motors lose 0.9 to 1.3 times as much.
double commutation_loss(const MotorModel& motor, double current_A);

/// Speeds at which a speed loop is tested. The load is half of the nominal current's torque. The top speed is
/// nine tenths of the highest speed with this load and its commutations.
struct TestSpeeds {
  double load_A = 0.0, top_rad_s = 0.0;
  /// Upper bound of the lowest speed, for two reasons. A step down to the lowest speed must begin at 1.2
  /// times this speed, and at the beginning the bus must drive the nominal current. 0 if the bus drives the
  /// nominal current at no speed.
  double most_lowest_rad_s = 0.0;
};
TestSpeeds test_speeds(const MotorModel& motor, double bus_V, double torque_limit_Nm);

/// Soft chopping brakes through the lower switches: at speed w the braking current is at least the
/// short-circuit current, K_t w/R_tt. The result is the highest speed at which the braking current can be as
/// low as i, (i/K_t) R_tt.
double soft_braking_limit_rad_s(const MotorModel& motor, double current_A);

/// Back-EMF that a commutation must overcome, relative to the peak E of a phase: 2 e_staying - e_entering -
/// e_leaving at the edge. It is 4 for a flat top of at least 120 degrees, and 3 for a sine.
double commutation_emfs(const plant::Machine& machine);
/// Highest speed w at which a duty can keep the staying phase's current i constant through a commutation:
/// commutation_emfs() K_e w + 3 R_s i = U_s, with R_s of a phase (sixstep/control/commutation_step.hpp). 0 if
/// no such speed exists.
double commutation_limit_rad_s(const MotorModel& motor, double bus_V, double current_A);

}  // namespace sixstep::design

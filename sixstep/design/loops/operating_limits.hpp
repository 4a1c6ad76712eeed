// SPDX-License-Identifier: Apache-2.0
// Computes the limits of bus, modulation and motor that do not depend on the gains: ripple, headroom over speed,
// braking.
#pragma once
#include "sixstep/control/bridge_command.hpp"
#include "sixstep/design/sheet/parameters.hpp"

namespace sixstep::design {

/// Change of the pair's mean voltage per duty, relative to the bus, with continuous current. If one switch of the
/// pair stays on, the off state puts 0 on the pair, u = d U: 1, soft and complementary. If both are off, the current
/// flows against the bus, u = d U - (1 - d) U: 2, hard.
double volts_per_duty(control::Chopping chopping);
/// The duty at which that mean voltage is the part u/U of the bus.
double duty_for_voltage(control::Chopping chopping, double part_of_bus);

/// Peak to peak of the driven pair's current in steady chopping at a duty, conduction continuous, ideal
/// switches: the pair has U_on for d T and U_off for (1 - d) T,
///   (U_on - U_off)/R (1 - exp(-d x)) (1 - exp(-(1 - d) x))/(1 - exp(-x)),   x = R T/L,
/// independent of the EMF. U_on - U_off = volts_per_duty() U_s.
double current_ripple_A(const MotorModel& motor, double bus_V, double period_s, control::Chopping chopping,
                        double duty);

/// The same ripple between two voltages across the pair, whose mean over a period is mean_V. 0 where mean_V is not
/// between them.
double ripple_between_A(const MotorModel& motor, double on_V, double off_V, double mean_V, double period_s);

struct Ripple {
  double worst_A = 0.0;  ///< peak to peak, at worst_duty = 0.5
  double worst_duty = 0.5;
  double continuous_above_A =
      0.0;  ///< half the worst: below this mean current a soft-chopped current is discontinuous
};
Ripple worst_ripple(const MotorModel& motor, double bus_V, double period_s, control::Chopping chopping);

/// Period at which the worst ripple is `ripple_A`; infinite if it stays below for any period.
double period_for_ripple_s(const MotorModel& motor, double bus_V, control::Chopping chopping,
                           double ripple_A);

/// Nominal current of a motor. If the sheet has none, it is a tenth of the stall current and `printed` is false,
/// which every output of the number must show.
struct NominalCurrent {
  double A = 0.0;
  bool printed = true;
};
NominalCurrent nominal_current(const MotorModel& motor, double bus_V);

/// Default torque limit of a drive: that of 2.5 times the nominal current, which a winding carries for seconds (2 to
/// 3 is usual), but no more than the bus drives through the held rotor.
inline constexpr double usual_overload = 2.5;
double usual_torque_limit_Nm(const MotorModel& motor, double bus_V);

/// Remaining voltage of the bus for changing the current i at speed w: U_s - R_tt i - K_t w. Negative: i cannot flow.
double headroom_V(const MotorModel& motor, double bus_V, double current_A, double speed_rad_s);
/// Speed at which the headroom for that current ends.
double speed_for_current_rad_s(const MotorModel& motor, double bus_V, double current_A);

/// Part of the highest speed at nominal current that counts as a high speed; the voltage left there is for control.
inline constexpr double high_speed_part = 0.9;

/// Speed lost during commutations at a current, relative to the speed that is left. In each sector of pi/(3 p w) the
/// entering phase takes over the current, which costs the bus L_s i of its volt seconds, L_s of a phase: 3 p L_s i/(pi K_t).
/// Simulated motors lose 0.9 to 1.3 times that.
double commutation_loss(const MotorModel& motor, double current_A);

/// Speeds at which a speed loop is tested: against half the torque of the nominal current, up to a tenth below the highest speed
/// with that load and its commutations.
struct TestSpeeds {
  double load_A = 0.0, top_rad_s = 0.0;
  /// Upper bound of the lowest speed: a fifth of it must remain above for a step down to it, and the bus must drive
  /// the nominal current there. 0 if the bus drives none at any speed.
  double most_lowest_rad_s = 0.0;
};
TestSpeeds test_speeds(const MotorModel& motor, double bus_V, double torque_limit_Nm);

/// Soft chopping brakes through the lower switches: at speed w the current cannot be less than the short circuit's
/// K_t w/R_tt. Result: highest speed at which a braking current i can be held, (i/K_t) R_tt.
double soft_braking_limit_rad_s(const MotorModel& motor, double current_A);

/// Back-EMF that a commutation must overcome, relative to the peak E of a phase: 2 e_staying - e_entering - e_leaving
/// at the edge. 4 for a flat top of at least 120 degrees, 3 for a sine.
double commutation_emfs(const plant::Machine& machine);
/// Highest speed at which a duty exists that holds the staying phase's current through a commutation, with R_s of a
/// phase: commutation_emfs() K_e w + 3 R_s i = U_s (sixstep/control/commutation_step.hpp). 0 if there is none.
double commutation_limit_rad_s(const MotorModel& motor, double bus_V, double current_A);

}  // namespace sixstep::design

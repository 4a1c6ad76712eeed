// SPDX-License-Identifier: Apache-2.0
// What bus, modulation and motor allow whatever the gains are: ripple, headroom over speed, braking.
#pragma once
#include "sixstep/control/bridge_command.hpp"
#include "sixstep/design/sheet/parameters.hpp"

namespace sixstep::design {

/// What a duty of 1 more adds to the pair's mean voltage, in parts of the bus, while its current flows without gaps. With one
/// switch of the pair on, the off state puts 0 on it, u = d U: 1, soft and complementary. Where both are off the current flows
/// against the bus, u = d U - (1 - d) U: 2, hard.
double volts_per_duty(control::Chopping chopping);
/// The duty at which that mean voltage is a part u/U of the bus.
double duty_for_voltage(control::Chopping chopping, double part_of_bus);

/// Peak to peak of the driven pair's current in steady chopping at a duty, conduction continuous, ideal
/// switches: the pair sees U_on for d T and U_off for (1 - d) T,
///   (U_on - U_off)/R (1 - exp(-d x)) (1 - exp(-(1 - d) x))/(1 - exp(-x)),   x = R T/L,
/// whatever the EMF. U_on - U_off = volts_per_duty() U_s.
double current_ripple_A(const MotorModel& motor, double bus_V, double period_s, control::Chopping chopping,
                        double duty);

struct Ripple {
  double worst_A = 0.0;  ///< peak to peak, at worst_duty = 0.5
  double worst_duty = 0.5;
  double continuous_above_A =
      0.0;  ///< half the worst: below this mean current a soft-chopped current has gaps
};
Ripple worst_ripple(const MotorModel& motor, double bus_V, double period_s, control::Chopping chopping);

/// The period at which the worst ripple is `ripple_A`; infinite where none is too long.
double period_for_ripple_s(const MotorModel& motor, double bus_V, control::Chopping chopping,
                           double ripple_A);

/// What a motor stands. Where the sheet names no nominal current, a tenth of the stall current stands in for
/// it, and `printed` is false: whatever shows the number says so.
struct NominalCurrent {
  double A = 0.0;
  bool printed = true;
};
NominalCurrent nominal_current(const MotorModel& motor, double bus_V);

/// Torque that a drive asks for where nobody said: of 2.5 times the nominal current, which a winding stands
/// for seconds (2 to 3 is usual), and no more than the bus drives through the held rotor.
inline constexpr double usual_overload = 2.5;
double usual_torque_limit_Nm(const MotorModel& motor, double bus_V);

/// What is left of the bus for changing the current i at speed w: U_s - R_tt i - K_t w. Negative: i cannot
/// flow.
double headroom_V(const MotorModel& motor, double bus_V, double current_A, double speed_rad_s);
/// Where the headroom for that current ends.
double speed_for_current_rad_s(const MotorModel& motor, double bus_V, double current_A);

/// Of the speed up to which the bus drives the nominal current: what is left above it is for control.
inline constexpr double high_speed_part = 0.9;

/// Where a speed loop is tried: against half the nominal torque, from a tenth below the speed that the bus drives so.
struct TestSpeeds {
  double load_A = 0.0, top_rad_s = 0.0;
  /// The most that may be the lowest speed: a fifth of it is left above for a step down to it, and the bus drives the nominal current
  /// there. 0 where it drives none at any speed.
  double most_lowest_rad_s = 0.0;
};
TestSpeeds test_speeds(const MotorModel& motor, double bus_V, double torque_limit_Nm);

/// Soft chopping brakes through the lower switches: at speed w the current cannot be less than the short
/// circuit's K_t w/R_tt. The speed above which a braking current i can no longer be held: (i/K_t) R_tt.
double soft_braking_limit_rad_s(const MotorModel& motor, double current_A);

}  // namespace sixstep::design

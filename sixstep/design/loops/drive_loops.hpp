// SPDX-License-Identifier: Apache-2.0
// The drive's loops as open loops in z: motor with back-EMF, held voltage, delay, and the loops within.
#pragma once
#include <vector>

#include "sixstep/control/bridge_command.hpp"
#include "sixstep/design/loops/field_current.hpp"
#include "sixstep/design/loops/pole_placement.hpp"
#include "sixstep/design/loops/transfer.hpp"
#include "sixstep/design/sheet/parameters.hpp"

namespace sixstep::design {

/// What the voltage that the current controller asks for acts on: L di/dt = u - R i - K_e w, and J dw/dt = K_t i - B w, d theta/dt = w.
struct LoopWinding {
  double R_ohm = 0.0, L_H = 0.0;
  double back_emf_V_s = 0.0;  ///< K_e
  double torque_Nm_A = 0.0;   ///< K_t
};
/// Terminal values, K_e = K_t, each over s = volts_per_duty(): a duty of u/U puts s u and a constant on the pair, and
/// L di/dt = s u - R i - K_e w is the same winding with L/s, R/s and K_e/s. What is constant the integral makes up for.
LoopWinding driven_pair(const MotorModel& motor, control::Chopping chopping);
/// Rotor held: 1/(L s + R), sampled with zero-order hold.
ZohPlant current_plant(const LoopWinding& winding, double period_s);
/// Says it in a derivation where s is not 1.
void tell_chopping(control::Chopping chopping, std::vector<DerivationStep>& steps);
/// The axis across the magnet: R, L_q and p psi of a phase, and 3/2 p psi of torque. Decoupled, what turning makes is added to
/// what the controller asks for, and it sees none of it.
LoopWinding quadrature_axis(const FieldMachine& machine, bool decoupled);

struct DriveLoops {
  MotorModel motor;
  LoopWinding winding;
  double period_s = 0.0;
  double late_periods =
      0.0;  ///< from a sample until its answer acts: a sample in the middle of a period adds a half
  PiGains current{};
  PiGains speed{};
  double current_at_full_torque_A = 0.0;
  double position_gain_rad_s_per_deg = 0.0;
};

/// A speed controller that sees setpoint and speed each its own way: u = (setpoint r - speed y)/q, in z - 1.
struct LinearLaw {
  Polynomial r, y, q;
};

/// Rotor held, as it is designed. The voltage that is asked for acts late_periods after its sample, for one period.
Transfer open_current_loop(const DriveLoops& drive);
/// Rotor free: its back-EMF gives way to a slow change of the current.
Transfer open_current_loop_turning(const DriveLoops& drive);
/// From speed error to speed, the current loop closed within.
Transfer open_speed_loop(const DriveLoops& drive);
/// The loop L that a PI would need for the same answer to its setpoint, T = L/(1 + L): what a measurement of T shows.
Transfer speed_loop_by_setpoint(const DriveLoops& drive, const LinearLaw& law);
/// The loop opened at the output of the controller: what margins are of.
Transfer open_speed_loop(const DriveLoops& drive, const LinearLaw& law);
/// From position error to position, both loops closed within.
Transfer open_position_loop(const DriveLoops& drive);

}  // namespace sixstep::design

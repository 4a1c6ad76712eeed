// SPDX-License-Identifier: Apache-2.0
// Computes the drive's loops as open loops in z, including back-EMF, the held voltage, the delay and the
// inner loops.
#pragma once
#include <vector>

#include "sixstep/control/bridge_command.hpp"
#include "sixstep/design/loops/field_current.hpp"
#include "sixstep/design/loops/pole_placement.hpp"
#include "sixstep/design/loops/transfer.hpp"
#include "sixstep/design/sheet/parameters.hpp"

namespace sixstep::design {

/// Winding that the current controller drives, L di/dt = u - R i - K_e w with voltage u and speed w; its torque
/// K_t i accelerates the shaft (J, B of the MotorModel).
struct LoopWinding {
  double R_ohm = 0.0, L_H = 0.0;
  double back_emf_V_s = 0.0;  ///< K_e, V per rad/s
  double torque_Nm_A = 0.0;   ///< K_t, N m/A
};
/// Winding of the driven pair: terminal values, K_e = K_t, each divided by s = volts_per_duty(). A duty of
/// u/U gives the pair s u plus a constant. L di/dt = s u - R i - K_e w is then the same as a winding with
/// L/s, R/s and K_e/s; the integral compensates the constant.
LoopWinding driven_pair(const MotorModel& motor, control::Chopping chopping);
/// Current plant with the rotor held: 1/(L s + R), sampled with zero-order hold.
ZohPlant current_plant(const LoopWinding& winding, double period_s);
/// Adds a step about the chopping to a derivation, unless volts_per_duty() is 1.
void tell_chopping(control::Chopping chopping, std::vector<DerivationStep>& steps);
/// Winding of the q axis: R and L_q of a phase, K_e = p psi, K_t = 3/2 p psi. If the axes are decoupled, K_e = 0,
/// because the controller adds the rotation's voltage itself.
LoopWinding quadrature_axis(const FieldMachine& machine, bool decoupled);

struct DriveLoops {
  MotorModel motor;
  LoopWinding winding;
  double period_s = 0.0;
  double late_periods =
      0.0;  ///< delay from a sample until its output acts; half a period more if samples are in the middle of
            ///< a period
  PiGains current{};
  PiGains speed{};
  double current_at_full_torque_A = 0.0;
  double position_gain_rad_s_per_deg = 0.0;
};

/// A speed controller with separate paths for setpoint and speed: u = (setpoint r - speed y)/q, in powers of
/// z - 1.
struct LinearLaw {
  Polynomial r, y, q;
};

/// Open current loop with the rotor held, as in the design. The controller's voltage acts late_periods after
/// its sample, for one period.
Transfer open_current_loop(const DriveLoops& drive);
/// Open current loop with the rotor free: the current accelerates the rotor, and the back-EMF reacts to slow
/// changes.
Transfer open_current_loop_turning(const DriveLoops& drive);
/// Open speed loop, from speed error to speed, with the current loop closed.
Transfer open_speed_loop(const DriveLoops& drive);
/// The loop L for which the law's response to the setpoint is T = L/(1 + L), as for a PI's open loop. L can
/// be computed from a measured T.
Transfer speed_loop_by_setpoint(const DriveLoops& drive, const LinearLaw& law);
/// The speed loop, opened at the controller's output. Margins are defined for this loop.
Transfer open_speed_loop(const DriveLoops& drive, const LinearLaw& law);
/// Open position loop, from position error to position, with both inner loops closed.
Transfer open_position_loop(const DriveLoops& drive);

}  // namespace sixstep::design

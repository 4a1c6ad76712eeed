// SPDX-License-Identifier: Apache-2.0
// Converts a data sheet to the parameters of the model, which has SI units and only one frame.
#pragma once
#include <string>

#include "sixstep/base/result.hpp"
#include "sixstep/design/sheet/sheet_constants.hpp"
#include "sixstep/plant/machine.hpp"

namespace sixstep::design {

/// For each constant, as text, the line of the sheet from which it was read.
struct Origins {
  std::string R, L, K_e, K_t, J, friction;
};

struct MotorModel {
  MotorKind kind = MotorKind::rotary;  ///< if linear, every rad below means m, every N m means N, every kg m2
                                       ///< means kg
  plant::Machine machine;  ///< if the back-EMF is a table: the machine with a sine of the same K_t, for
                           ///< closed forms
  plant::Shaft shaft;
  double K_e_V_s = 0.0;  ///< K_e of the sheet's shape; equals machine.K_e_V_s unless the shape is a table
  bool shape_is_table = false;
  IronDrag iron;  ///< the iron's part of the shaft's friction, if the sheet separates it
  double K_t_Nm_A =
      0.0;  ///< torque constant between terminals: torque per ampere through the driven pair, mean over a
            ///< sector
  double nominal_voltage_V = 0.0;    ///< as printed; 0 if it is not printed
  double no_load_speed_rad_s = 0.0;  ///< as printed; 0 if it is not printed
  double no_load_current_A = 0.0;
  double nominal_current_A = 0.0;  ///< through the driven pair, as printed or of equal torque; 0 if it is not
                                   ///< printed
  double stall_torque_Nm = 0.0;    ///< as printed, else K_t U/R_tt; 0 if the voltage is not printed either
  Origins from;
  /// Effects of the sheet that are not in this model of equal phases, as text: "cogging and a delta's loop
  /// current". A run simulates them. Design, curve and the exported model use their means. Empty if there are
  /// none.
  std::string left_to_a_run;
};

/// The constants of sheet_constants.hpp as a model: R_s = R_tt/2, L_s = L_tt/2, and K_e from K_t by the
/// shape's mean over a sector (model.md 1): K_t/2 for the trapezoid of 120 degrees and K_t/1.65399 for a
/// sine. Without a viscous coefficient the no-load point (current I_0, speed w_0) and the dry friction T_c
/// determine it: B = (K_t I_0 - T_c)/w_0. A sheet without coefficient and no-load point has no friction. All
/// Problems are returned together; each names the key, its value and the broken rule.
base::Result<MotorModel> motor_model(const Sheet& sheet);

/// MotorModel::left_to_a_run for a sheet.
std::string left_to_a_run(const Sheet& sheet);

/// True if L_d and L_q are given instead of one inductance, and differ.
bool is_salient(const Sheet& sheet);

}  // namespace sixstep::design

// SPDX-License-Identifier: Apache-2.0
// Data sheet -> model parameters: frames and units end here.
#pragma once
#include <string>

#include "sixstep/base/result.hpp"
#include "sixstep/design/sheet/sheet_constants.hpp"
#include "sixstep/plant/machine.hpp"

namespace sixstep::design {

/// Which line of the sheet each constant was read from, in words.
struct Origins {
  std::string R, L, K_e, K_t, J, friction;
};

struct MotorModel {
  MotorKind kind = MotorKind::rotary;  ///< linear: every rad below is a m, every N m an N, every kg m2 a kg
  plant::Machine
      machine;  ///< of a back-EMF given as a table: the sine of the same K_t, for what goes by closed forms
  plant::Shaft shaft;
  double K_e_V_s =
      0.0;  ///< what the shape that the sheet gives is multiplied with: machine's, unless that is a table
  bool shape_is_table = false;
  IronDrag iron;  ///< the iron's part of the shaft's friction, where the sheet tells it apart
  double K_t_Nm_A =
      0.0;  ///< terminal torque constant: torque per ampere through the driven pair, sector mean
  double nominal_voltage_V = 0.0;    ///< as printed; 0 where the sheet is silent
  double no_load_speed_rad_s = 0.0;  ///< as printed; 0 where the sheet is silent
  double no_load_current_A = 0.0;
  double nominal_current_A = 0.0;  ///< through the driven pair, as printed or of equal torque; 0: silent
  double stall_torque_Nm = 0.0;    ///< as printed, else K_t U/R_tt; 0 where the sheet has no voltage either
  Origins from;
  /// What the sheet has and this model of equal phases has not, in words: "cogging and a delta's loop current". A run has it;
  /// design, curve and the exported model go by their means. Empty where nothing is left out.
  std::string left_to_a_run;
};

/// The constants of sheet_constants.hpp as a model: R_s = R_tt/2, L_s = L_tt/2, K_e from K_t by the shape's
/// sector mean (model.md 1): K_t/2 for the 120 degree trapezoid, K_t/1.65399 for a sine. Without a viscous
/// coefficient the no-load point pays for all friction: B = (K_t I_0 - T_c)/w_0; a sheet that has neither
/// turns without loss. All Problems come at once; each names the key, its value and the rule that is broken.
base::Result<MotorModel> motor_model(const Sheet& sheet);

/// MotorModel::left_to_a_run of a sheet.
std::string left_to_a_run(const Sheet& sheet);

/// L_d and L_q are given in the place of one inductance, and differ.
bool is_salient(const Sheet& sheet);

}  // namespace sixstep::design

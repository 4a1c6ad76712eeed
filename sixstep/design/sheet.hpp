// SPDX-License-Identifier: Apache-2.0
// A motor's data sheet, as printed: the sheet's own units and frames, each value with its source.
#pragma once
#include <cstdint>
#include <optional>
#include <string>

#include "sixstep/base/describe.hpp"

namespace sixstep::design {

enum class BackEmfShape : std::uint8_t { trapezoid, sine };

struct Sheet {
  std::string name;
  std::string maker;
  std::string notes;
  int pole_pairs = 0;
  BackEmfShape back_emf = BackEmfShape::trapezoid;
  double flat_deg = 120.0;  // width of the trapezoid's flat top, electrical

  base::Quantity nominal_voltage_V;
  base::Quantity resistance_ohm;                        // frame terminal or phase
  base::Quantity inductance_mH;                         // frame terminal or phase
  std::optional<base::Quantity> torque_constant_mNm_A;  // terminal: torque per ampere through the driven pair
  std::optional<base::Quantity> back_emf_mV_s;  // frame phase: peak per mechanical rad/s, used as it is
  base::Quantity inertia_gcm2;
  std::optional<base::Quantity>
      viscous_friction_Nm_s;  // default: what the no-load loss leaves, (K_t I_0 - T_c)/w_0
  std::optional<base::Quantity> coulomb_friction_mNm;

  std::optional<base::Quantity> no_load_speed_rpm, no_load_current_mA;
  std::optional<base::Quantity> nominal_speed_rpm, nominal_torque_mNm, nominal_current_A;
  std::optional<base::Quantity> stall_torque_mNm, stall_current_A;
  std::optional<base::Quantity> speed_constant_rpm_V;
  std::optional<base::Quantity> max_speed_rpm;

  std::optional<base::Quantity> thermal_resistance_winding_housing_K_W;
  std::optional<base::Quantity> thermal_resistance_housing_ambient_K_W;
  std::optional<base::Quantity> thermal_time_constant_winding_s, thermal_time_constant_motor_s;
  std::optional<base::Quantity> max_winding_temperature_degC;
};

}  // namespace sixstep::design

// SPDX-License-Identifier: Apache-2.0
// A motor's data sheet as printed: the sheet's own units and frames, each value with its source. Makers print
// a constant in different forms. A file gives each constant in one form, or in several forms, which are then
// compared (sheet_constants.hpp, sheet_check.hpp). A linear motor's sheet uses the same members, with 1 rad
// for 1 m, under its own key names (base/linear.hpp, sheet_spellings.hpp).
#pragma once
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "sixstep/base/describe.hpp"

namespace sixstep::design {

enum class BackEmfShape : std::uint8_t { trapezoid, sine, table };

enum class WindingConnection : std::uint8_t { star, delta };

enum class MotorKind : std::uint8_t { rotary, linear };

enum class RotorPlace : std::uint8_t { inner, outer };

/// Density of a rotor if the file gives none.
inline constexpr double steel_kg_m3 = 7850.0;

struct Sheet {
  std::string name;
  std::string maker;
  std::string notes;
  bool simulatable = true;
  std::string not_simulatable_because;
  std::vector<std::string> known_deviation;  // names of relations in the sheet check that this sheet is known
                                             // to violate

  MotorKind kind = MotorKind::rotary;
  std::optional<base::Quantity> pole_pitch_mm;  // linear motor: tau, instead of pole pairs
  std::optional<int> pole_pairs;                // or `poles`, or `winding`
  std::optional<int> poles;
  std::string winding;  // the winding's code; "12N14P" has 12 teeth and 14 poles
  BackEmfShape back_emf = BackEmfShape::trapezoid;
  double flat_deg = 120.0;                                 // width of the trapezoid's flat top, electrical
  std::vector<double> harmonic_orders, harmonic_sizes;     // without order 1; sizes relative to the sine's
                                                           // peak
  std::vector<double> back_emf_angle_deg, back_emf_shape;  // table: points of phase a over one electrical
                                                           // turn
  std::string back_emf_file;  // table: file with the two lists, as written; text/ reads the file
  WindingConnection connection = WindingConnection::star;
  double mutual_inductance_mH = 0.0;  // delta: between two branches
  std::vector<double> phase_resistance_deviation,
      phase_back_emf_deviation;  // relative deviations of phases a, b, c
  std::vector<double> cogging_orders, cogging_mNm, cogging_phase_deg;  // periods per turn of the shaft

  std::optional<base::Quantity> nominal_voltage_V;
  std::optional<base::Quantity> resistance_ohm;                              // frame terminal or phase
  std::optional<base::Quantity> inductance_mH;                               // frame terminal or phase
  std::optional<base::Quantity> d_axis_inductance_mH, q_axis_inductance_mH;  // frame phase; both instead of
                                                                             // inductance_mH

  std::optional<base::Quantity>
      saturation_current_A;  // I_sat of a phase's flux linkage along the magnet, L_d i_d (1 - i_d/(2 I_sat))

  // The torque constant in its printed forms. The first given form, in this order, is used.
  std::optional<base::Quantity> torque_constant_mNm_A;  // terminal: torque per ampere through the driven pair
  std::optional<base::Quantity> back_emf_mV_s;         // frame phase: peak per mechanical rad/s, used without
                                                       // conversion
  std::optional<base::Quantity> torque_constant_Nm_A;  // frame terminal, peak or rms
  std::optional<base::Quantity> back_emf_constant_V_krpm;  // frames line or phase, peak or rms; six-step
  std::optional<base::Quantity> flux_linkage_mWb;          // phase, peak of the fundamental
  std::optional<base::Quantity> speed_constant_rpm_V;      // frames six-step or line-peak: "KV"
  std::optional<base::Quantity> flux_density_T, active_length_mm, air_gap_radius_mm;  // K_t = 2 B l r N
  std::optional<int> turns_in_series;                                                 // between two terminals

  std::optional<base::Quantity> inertia_gcm2;
  std::optional<base::Quantity> inertia_with_brake_gcm2;
  bool with_brake = false;
  RotorPlace rotor = RotorPlace::inner;
  std::optional<base::Quantity> rotor_radius_mm, rotor_inner_radius_mm, rotor_length_mm;
  std::optional<base::Quantity> rotor_density_kg_m3;  // default: steel_kg_m3
  std::optional<base::Quantity> viscous_friction_Nm_s;
  std::optional<base::Quantity> coulomb_friction_mNm;
  std::optional<base::Quantity> iron_viscous_Nm_s, iron_coulomb_mNm;  // parts of the friction by eddy
                                                                      // currents and by hysteresis

  std::optional<base::Quantity> no_load_voltage_V;  // voltage of the no-load point; default: the nominal
                                                    // voltage
  std::optional<base::Quantity> no_load_speed_rpm, no_load_current_mA;
  std::optional<base::Quantity> second_no_load_voltage_V, second_no_load_speed_rpm, second_no_load_current_mA;
  std::optional<base::Quantity> nominal_speed_rpm, nominal_torque_mNm, nominal_current_A;
  std::optional<base::Quantity> stall_torque_mNm, stall_current_A;
  std::optional<base::Quantity> max_efficiency_percent;
  std::optional<base::Quantity> speed_torque_gradient_rpm_mNm;
  std::optional<base::Quantity> mechanical_time_constant_ms, electrical_time_constant_ms;
  std::optional<base::Quantity> max_speed_rpm;

  std::optional<base::Quantity> thermal_resistance_winding_housing_K_W;
  std::optional<base::Quantity> thermal_resistance_housing_ambient_K_W;
  std::optional<base::Quantity> thermal_time_constant_winding_s, thermal_time_constant_motor_s;
  std::optional<base::Quantity> max_winding_temperature_degC;
  double magnet_loss_percent_K = 0.12;  // loss of K_e above 25 degC per kelvin; default: value of NdFeB
};

}  // namespace sixstep::design

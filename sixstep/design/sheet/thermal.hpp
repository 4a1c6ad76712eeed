// SPDX-License-Identifier: Apache-2.0
// Temperatures of a motor in closed form: two bodies, winding and housing, as a data sheet describes them.
//
//   C_w dT_w/dt = P (1 + a (T_w - 25)) - (T_w - T_h)/R_wh          P copper loss at 25 degC, a = 0.393 %/K
//   C_h dT_h/dt = (T_w - T_h)/R_wh - (T_h - T_a)/R_ha + P_f        P_f heat into the housing: friction
//   C_w = tau_w/R_wh, C_h = tau_m/R_ha
//
// The heating by a given current grows with the copper's temperature, but the equations stay linear. The
// steady state therefore needs no iteration, and the temperatures are sums of two exponentials, also if the
// current is too high for a steady state. The magnets have the housing's temperature, K_e(T_h) = K_e (1 - b
// (T_h - 25)). A mounting plate that cools the stator better than the sheet's R_ha is not modelled.
#pragma once
#include <cmath>
#include <optional>
#include <string>

#include "sixstep/base/result.hpp"
#include "sixstep/design/sheet/parameters.hpp"
#include "sixstep/plant/two_bodies.hpp"

namespace sixstep::design {

/// Temperature coefficient of copper, 1/K, and the temperature at which the sheet's resistance is assumed to
/// hold, degC.
inline constexpr double copper_per_K = 0.00393, sheet_degC = 25.0;

struct ThermalModel {
  double winding_housing_K_W = 0.0, housing_ambient_K_W = 0.0;
  double winding_s = 0.0, motor_s = 0.0;  ///< time constants of winding and housing
  double max_winding_degC = 0.0;
};

/// The model needs all five thermal lines of the sheet. One Problem names the missing lines.
base::Result<ThermalModel> thermal_model(const Sheet& sheet);

struct Temperatures {
  double winding_degC = sheet_degC, housing_degC = sheet_degC;
};

/// Temperature factor of the sheet's R, which holds at sheet_degC.
inline double on_R(const Temperatures& t) { return 1 + copper_per_K * (t.winding_degC - sheet_degC); }
/// Temperature factor of the sheet's K_e and K_t, which hold at sheet_degC; at least plant::least_on_K_e, as
/// in a run.
inline double on_K_e(const Sheet& s, const Temperatures& t) {
  return std::fmax(plant::least_on_K_e, 1 - 1e-2 * s.magnet_loss_percent_K * (t.housing_degC - sheet_degC));
}
/// Problem if K_e is at the lower bound plant::least_on_K_e; `where` names the housing's temperature.
std::optional<base::Problem> lost_magnets(const std::string& where, const Sheet& s, double housing_degC);
MotorModel warmed(MotorModel motor, const Sheet& sheet, const Temperatures& t);

/// Heat sources, constant over time, and the ambient temperature.
struct Heating {
  double copper_W = 0.0;   ///< loss of the winding at sheet_degC
  double housing_W = 0.0;  ///< direct heat into the housing
  double ambient_degC = sheet_degC;
};

/// Steady state; empty if there is no steady state, because the heating grows with the copper's resistance
/// without limit.
std::optional<Temperatures> steady_temperatures(const ThermalModel& model, const Heating& heating);

/// Temperatures `seconds` after `start`.
Temperatures temperatures_after(const ThermalModel& model, const Heating& heating, const Temperatures& start,
                                double seconds);

/// Time, s, until the winding reaches its limit, from `start` on, or from ambient temperature. Empty: it settles at
/// the limit or below. 0: it is already at the limit, or the ambient temperature is.
std::optional<double> permissible_seconds(const ThermalModel& model, const Heating& heating,
                                          const Temperatures& start);
std::optional<double> permissible_seconds(const ThermalModel& model, const Heating& heating);

/// Steady temperatures with the winding at its limit and with `housing_W` of direct heat into the housing.
Temperatures at_the_limit(const ThermalModel& model, double housing_W, double ambient_degC);

/// The copper loss at sheet_degC, W, that heats the winding to its limit: continuously, or, for
/// short_time_copper_W(), from ambient temperature within `seconds`. 0 if the housing's heat is already
/// sufficient.
double continuous_copper_W(const ThermalModel& model, double housing_W, double ambient_degC);
double short_time_copper_W(const ThermalModel& model, double housing_W, double ambient_degC, double seconds);

}  // namespace sixstep::design

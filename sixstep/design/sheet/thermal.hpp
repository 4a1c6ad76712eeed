// SPDX-License-Identifier: Apache-2.0
// How warm a motor gets, in closed form: two bodies, winding and housing, as a data sheet describes them.
//
//   C_w dT_w/dt = P (1 + a (T_w - 25)) - (T_w - T_h)/R_wh          P copper loss at 25 degC, a = 0.393 %/K
//   C_h dT_h/dt = (T_w - T_h)/R_wh - (T_h - T_a)/R_ha + P_f        P_f what warms the housing: friction
//   C_w = tau_w/R_wh, C_h = tau_m/R_ha
//
// A given current heats more the warmer its copper is; the equations stay linear all the same, so that the
// balance needs no iteration and the answer is two exponentials, also where the current is so high that it
// never comes to rest. The magnets are as warm as the housing, K_e(T_h) = K_e (1 - b (T_h - 25)). Left out: a stator that is cooled
// by its mounting plate better than the sheet's R_ha says.
#pragma once
#include <cmath>
#include <optional>
#include <string>

#include "sixstep/base/result.hpp"
#include "sixstep/design/sheet/parameters.hpp"
#include "sixstep/plant/two_bodies.hpp"

namespace sixstep::design {

/// Temperature coefficient of copper, 1/K, and the temperature the sheet's resistance is taken to belong to.
inline constexpr double copper_per_K = 0.00393, sheet_degC = 25.0;

struct ThermalModel {
  double winding_housing_K_W = 0.0, housing_ambient_K_W = 0.0;
  double winding_s = 0.0, motor_s = 0.0;  ///< time constants of winding and housing
  double max_winding_degC = 0.0;
};

/// All five lines of the sheet; one Problem names those that are missing.
base::Result<ThermalModel> thermal_model(const Sheet& sheet);

struct Temperatures {
  double winding_degC = sheet_degC, housing_degC = sheet_degC;
};

/// What temperatures make of a winding's R and of the magnets' K_e and K_t: factors on what the sheet gives at sheet_degC.
inline double on_R(const Temperatures& t) { return 1 + copper_per_K * (t.winding_degC - sheet_degC); }
/// No less than plant::least_on_K_e, as a run has it.
inline double on_K_e(const Sheet& s, const Temperatures& t) {
  return std::fmax(plant::least_on_K_e, 1 - 1e-2 * s.magnet_loss_percent_K * (t.housing_degC - sheet_degC));
}
/// What there is to tell where they start at that least: `where` names the housing's temperature.
std::optional<base::Problem> lost_magnets(const std::string& where, const Sheet& s, double housing_degC);
MotorModel warmed(MotorModel motor, const Sheet& sheet, const Temperatures& t);

/// What heats, constant over time, and the air around.
struct Heating {
  double copper_W = 0.0;   ///< loss of the winding if it were at sheet_degC
  double housing_W = 0.0;  ///< warms the housing directly
  double ambient_degC = sheet_degC;
};

/// Where the temperatures come to rest; empty where they never do: the copper's growing resistance runs away.
std::optional<Temperatures> steady_temperatures(const ThermalModel& model, const Heating& heating);

/// After `seconds` from `start`.
Temperatures temperatures_after(const ThermalModel& model, const Heating& heating, const Temperatures& start,
                                double seconds);

/// How long a motor at ambient temperature may be heated so until its winding reaches the limit, s: empty for
/// ever, 0 where the air is that warm already.
std::optional<double> permissible_seconds(const ThermalModel& model, const Heating& heating);

/// Where the motor is that its winding takes to its limit in the end: the housing's own heat beside it.
Temperatures at_the_limit(const ThermalModel& model, double housing_W, double ambient_degC);

/// The copper loss at sheet_degC, W, that takes the winding to its limit: for ever, or from ambient
/// temperature just after `seconds`. 0 where the housing's heat alone does.
double continuous_copper_W(const ThermalModel& model, double housing_W, double ambient_degC);
double short_time_copper_W(const ThermalModel& model, double housing_W, double ambient_degC, double seconds);

}  // namespace sixstep::design

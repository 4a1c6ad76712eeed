// SPDX-License-Identifier: Apache-2.0
#include "sixstep/design/sheet/thermal.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "sixstep/base/written.hpp"

namespace sixstep::design {
namespace {

plant::TwoBodies network(const ThermalModel& m, const Heating& h) {
  const double per_C_w = m.winding_housing_K_W / m.winding_s, per_C_h = m.housing_ambient_K_W / m.motor_s;
  const double across = 1 / m.winding_housing_K_W, out = 1 / m.housing_ambient_K_W;
  const double cold = h.copper_W * (1 + copper_per_K * (h.ambient_degC - sheet_degC));
  return {(h.copper_W * copper_per_K - across) * per_C_w,
          across * per_C_w,
          across * per_C_h,
          -(across + out) * per_C_h,
          cold * per_C_w,
          h.housing_W * per_C_h};
}

double winding_after(const ThermalModel& m, const Heating& h, double seconds) {
  const Temperatures ambient{h.ambient_degC, h.ambient_degC};
  return temperatures_after(m, h, ambient, seconds).winding_degC;
}

/// Smallest x at which reached(x) is true, by bisection down to neighbouring numbers. reached() is false at
/// `low` and true at `high`.
template <class Reached>
double threshold(double low, double high, Reached&& reached) {
  for (;;) {
    const double middle = low + (high - low) / 2;
    if (!(low < middle && middle < high)) return high;
    (reached(middle) ? high : low) = middle;
  }
}

}  // namespace

MotorModel warmed(MotorModel m, const Sheet& s, const Temperatures& t) {
  const double emf = on_K_e(s, t);
  m.machine.R_ohm *= on_R(t);
  m.machine.K_e_V_s *= emf;
  m.K_e_V_s *= emf;
  m.K_t_Nm_A *= emf;
  return m;
}

std::optional<base::Problem> lost_magnets(const std::string& where, const Sheet& s, double housing_degC) {
  if (on_K_e(s, {.housing_degC = housing_degC}) > plant::least_on_K_e) return std::nullopt;
  return base::Problem{where, base::written(housing_degC),
                       "leaves the magnets at most a tenth of their flux, by magnet_loss_percent_K = " +
                           base::written(s.magnet_loss_percent_K),
                       "lower the temperature, or correct magnet_loss_percent_K in the motor file"};
}

base::Result<ThermalModel> thermal_model(const Sheet& s) {
  ThermalModel m;
  std::string missing;
  const auto take = [&](const std::optional<base::Quantity>& from, const char* key, double& to) {
    if (from)
      to = from->value;
    else
      missing += (missing.empty() ? "" : ", ") + std::string(key);
  };
  take(s.thermal_resistance_winding_housing_K_W, "thermal_resistance_winding_housing_K_W",
       m.winding_housing_K_W);
  take(s.thermal_resistance_housing_ambient_K_W, "thermal_resistance_housing_ambient_K_W",
       m.housing_ambient_K_W);
  take(s.thermal_time_constant_winding_s, "thermal_time_constant_winding_s", m.winding_s);
  take(s.thermal_time_constant_motor_s, "thermal_time_constant_motor_s", m.motor_s);
  take(s.max_winding_temperature_degC, "max_winding_temperature_degC", m.max_winding_degC);
  if (!missing.empty())
    return base::Problem{missing, "", "must be in the motor file for a continuous and short-time region",
                         "add the sheet's thermal lines to the motor file"};
  for (const double* value : {&m.winding_housing_K_W, &m.housing_ambient_K_W, &m.winding_s, &m.motor_s})
    if (!base::above(0).holds(*value))
      return base::Problem{"thermal resistances and time constants", "", "must be above 0",
                           "correct the thermal lines in the motor file"};
  return m;
}

std::optional<Temperatures> steady_temperatures(const ThermalModel& m, const Heating& h) {
  const plant::TwoBodies n = network(m, h);
  // Both eigenvalues are real (wh hw > 0). They are negative exactly if the determinant is positive and the
  // trace negative. Otherwise the heating grows faster with temperature than the cooling.
  if (!(n.determinant() > 0 && n.ww + n.hh < 0)) return {};
  const double winding = (n.wh * n.b_h - n.hh * n.b_w) / n.determinant();
  const double housing = (n.hw * n.b_w - n.ww * n.b_h) / n.determinant();
  return Temperatures{h.ambient_degC + winding, h.ambient_degC + housing};
}

Temperatures temperatures_after(const ThermalModel& m, const Heating& h, const Temperatures& start,
                                double t) {
  const plant::BodyTemperatures end = plant::after(
      network(m, h), {start.winding_degC - h.ambient_degC, start.housing_degC - h.ambient_degC}, t);
  return {h.ambient_degC + end.winding, h.ambient_degC + end.housing};
}

std::optional<double> permissible_seconds(const ThermalModel& m, const Heating& h,
                                          const Temperatures& start) {
  if (std::fmax(h.ambient_degC, start.winding_degC) >= m.max_winding_degC) return 0.0;
  const std::optional<Temperatures> rest = steady_temperatures(m, h);
  if (rest && rest->winding_degC <= m.max_winding_degC) return {};
  // A sum of two exponentials has one extreme at most: a winding that ends above its limit may cool down first, and
  // passes the limit once.
  const auto reaches = [&](double t) {
    return temperatures_after(m, h, start, t).winding_degC >= m.max_winding_degC;
  };
  double late = m.winding_s;
  while (!reaches(late)) late *= 2;
  return threshold(0.0, late, reaches);
}

std::optional<double> permissible_seconds(const ThermalModel& m, const Heating& h) {
  return permissible_seconds(m, h, {h.ambient_degC, h.ambient_degC});
}

Temperatures at_the_limit(const ThermalModel& m, double housing_W, double ambient_degC) {
  const double above = m.max_winding_degC - ambient_degC;
  const double across = 1 / m.winding_housing_K_W, out = 1 / m.housing_ambient_K_W;
  return {m.max_winding_degC, ambient_degC + (above * across + housing_W) / (across + out)};
}

double continuous_copper_W(const ThermalModel& m, double housing_W, double ambient_degC) {
  const Temperatures limit = at_the_limit(m, housing_W, ambient_degC);
  const double hot = (limit.winding_degC - limit.housing_degC) / m.winding_housing_K_W;
  return hot > 0 ? hot / (1 + copper_per_K * (m.max_winding_degC - sheet_degC)) : 0.0;
}

double short_time_copper_W(const ThermalModel& m, double housing_W, double ambient_degC, double seconds) {
  const auto reaches = [&](double copper_W) {
    return winding_after(m, {copper_W, housing_W, ambient_degC}, seconds) >= m.max_winding_degC;
  };
  if (ambient_degC >= m.max_winding_degC || reaches(0.0)) return 0.0;
  double high = std::max(continuous_copper_W(m, housing_W, ambient_degC), 1.0);
  while (!reaches(high)) high *= 2;
  return threshold(0.0, high, reaches);
}

}  // namespace sixstep::design

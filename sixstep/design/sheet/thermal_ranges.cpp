// SPDX-License-Identifier: Apache-2.0
#include "sixstep/design/sheet/thermal_ranges.hpp"

#include <algorithm>

#include "sixstep/base/written.hpp"

namespace sixstep::design {
namespace {

enum class Worse { higher, lower };

void take(const std::optional<base::Quantity>& from, const char* key, Worse worse, double& value,
          std::string& values) {
  if (!from || !from->range) return;
  const double end = worse == Worse::higher ? std::max(from->value, from->range->high)
                                            : std::min(from->value, from->range->low);
  if (end == from->value) return;
  value = end;
  values += (values.empty() ? "" : ", ") + std::string(key) + " = " + base::written(end);
}

}  // namespace

std::optional<WorseEnds> at_worse_ends(const Sheet& s) {
  const base::Result<ThermalModel> model = thermal_model(s);
  if (!model) return {};
  WorseEnds out{.model = *model, .values = {}};
  ThermalModel& m = out.model;
  take(s.thermal_resistance_winding_housing_K_W, "thermal_resistance_winding_housing_K_W", Worse::higher,
       m.winding_housing_K_W, out.values);
  take(s.thermal_resistance_housing_ambient_K_W, "thermal_resistance_housing_ambient_K_W", Worse::higher,
       m.housing_ambient_K_W, out.values);
  take(s.thermal_time_constant_winding_s, "thermal_time_constant_winding_s", Worse::lower, m.winding_s,
       out.values);
  take(s.thermal_time_constant_motor_s, "thermal_time_constant_motor_s", Worse::lower, m.motor_s, out.values);
  take(s.max_winding_temperature_degC, "max_winding_temperature_degC", Worse::lower, m.max_winding_degC,
       out.values);
  if (out.values.empty()) return {};
  return out;
}

base::Result<WithstandTimes> withstand_times(const Sheet& s, const Heating& heating) {
  return withstand_times(s, heating, {heating.ambient_degC, heating.ambient_degC});
}

base::Result<WithstandTimes> withstand_times(const Sheet& s, const Heating& heating,
                                             const Temperatures& start) {
  const base::Result<ThermalModel> model = thermal_model(s);
  if (!model) return model.problems();
  WithstandTimes out{.by_values = permissible_seconds(*model, heating, start),
                     .by_worse_ends = {},
                     .limit_degC = model->max_winding_degC,
                     .worse_limit_degC = model->max_winding_degC};
  out.by_worse_ends = out.by_values;
  if (const std::optional<WorseEnds> worse = at_worse_ends(s)) {
    out.by_worse_ends = permissible_seconds(worse->model, heating, start);
    out.worse_limit_degC = worse->model.max_winding_degC;
  }
  return out;
}

base::Result<ThermalModel> safe_thermal_model(const Sheet& s) {
  if (const std::optional<WorseEnds> worse = at_worse_ends(s)) return worse->model;
  return thermal_model(s);
}

double greater_rise(const ThermalModel& m, const ThermalModel& w) {
  const auto capacity = [](double s, double K_W) { return s / K_W; };
  return std::max(
      {w.winding_housing_K_W / m.winding_housing_K_W, w.housing_ambient_K_W / m.housing_ambient_K_W,
       capacity(m.winding_s, m.winding_housing_K_W) / capacity(w.winding_s, w.winding_housing_K_W),
       capacity(m.motor_s, m.housing_ambient_K_W) / capacity(w.motor_s, w.housing_ambient_K_W)});
}

}  // namespace sixstep::design

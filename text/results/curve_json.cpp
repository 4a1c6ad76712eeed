// SPDX-License-Identifier: Apache-2.0
#include "text/results/curve_json.hpp"

#include <cmath>
#include <nlohmann/json.hpp>

#include "sixstep/design/sheet/motion.hpp"
#include "sixstep/study/scenario/choices.hpp"
#include "text/escape/escape.hpp"
#include "text/escape/json_number.hpp"
#include "text/results/json_words.hpp"

namespace text {
namespace {

using Json = nlohmann::ordered_json;

Json point(const CurveRow& row) {
  Json out = Json::object();
  for (const CurveColumn& c : curve_columns()) out[c.column.name] = finite(c.value(row));
  return out;
}

Json bench(const analysis::CurveRequest& r) {
  const analysis::Bench& b = r.bench;
  return {{"voltage_V", b.voltage_V},
          {"duty", b.duty},
          {"chopping", base::word(study::chopping_choices, b.chopping)},
          {"pwm_period_s", b.pwm_period_s},
          {"on_resistance_ohm", b.devices.R_on_ohm},
          {"diode_drop_V", b.devices.V_f_V},
          {"ambient_degC", r.ambient_degC},
          {"winding_degC", r.motor_degC.winding_degC},
          {"housing_degC", r.motor_degC.housing_degC}};
}

/// A point that is not one of the curve's points, as JSON.
Json loose(const analysis::CurveRequest& r, const analysis::Curve& curve,
           const std::optional<analysis::OperatingPoint>& p) {
  return p ? point(curve_row(r, curve, *p, loose_point(r, curve, *p))) : Json(nullptr);
}

Json no_load(const analysis::CurveRequest& r, const analysis::Curve& curve) {
  Json out = loose(r, curve, curve.no_load.point);
  out["slope_Nm_s"] = curve.no_load.slope_Nm_s;
  out["half_width_rad_s"] = curve.no_load.half_width_rad_s;
  out["free_speed_rad_s"] = curve.no_load.free_speed_rad_s;
  out["free_winding_current_A"] = curve.no_load.free_winding_current_A;
  out["free_bus_current_A"] = curve.no_load.free_bus_current_A;
  out["free_s"] = curve.no_load.free_s;
  out["free_settled"] = curve.no_load.settled;
  out["time_constant_s"] = curve.no_load.time_constant_s;
  return out;
}

Json nominal(const analysis::CurveRequest& r, const analysis::Curve& curve) {
  if (!curve.nominal) return nullptr;
  const analysis::SpeedDrop d = analysis::speed_drop(r, curve);
  return {{"sheet_speed_rad_s", or_null(curve.nominal->speed_rad_s)},
          {"sheet_torque_Nm", or_null(curve.nominal->torque_Nm)},
          {"sheet_current_A", or_null(curve.nominal->current_A)},
          {"speed_drop_rad_s_Nm",
           {{"ideal", d.ideal},
            {"printed", or_null(d.printed)},
            {"sheet", or_null(d.sheet)},
            {"curve", or_null(d.curve)}}},
          {"curve_at_torque", loose(r, curve, curve.nominal->at_torque)},
          {"curve_at_speed", loose(r, curve, curve.nominal->at_speed)}};
}

Json locked(const analysis::OperatingPoint& turning) {
  const analysis::LockedRotor& l = *turning.locked;
  return {{"current_A", turning.winding_current_A},
          {"phase_rms_A", l.phase_rms_A},
          {"least_torque_Nm", l.least_torque_Nm},
          {"greatest_torque_Nm", l.greatest_torque_Nm},
          {"ripple_Nm", l.ripple_Nm}};
}

/// A thermal model, and the currents that it allows at standstill.
Json stands(const analysis::CurveRequest& r, const design::ThermalModel& m) {
  const analysis::ThermalLimits still = analysis::thermal_limits(m, r, 0.0);
  return {{"winding_housing_K_W", m.winding_housing_K_W},
          {"housing_ambient_K_W", m.housing_ambient_K_W},
          {"winding_s", m.winding_s},
          {"motor_s", m.motor_s},
          {"max_winding_degC", m.max_winding_degC},
          {"copper_per_K", design::copper_per_K},
          {"sheet_degC", design::sheet_degC},
          {"continuous_current_A", finite(still.continuous_A)},
          {"current_60s_A", finite(still.short_A[1])},
          {"current_10s_A", finite(still.short_A[0])}};
}

}  // namespace

std::string curve_json(const analysis::CurveRequest& r, const analysis::Curve& curve) {
  const base::Motion motion = design::motion_of(r.sheet);
  Json out = {{"sixstep", SIXSTEP_VERSION}, {"motor", r.sheet.name}, {"bench", bench(r)}};
  out["confidence_level"] = analysis::confidence_level;
  out["ideal"] = {{"stall_torque_Nm", analysis::ideal_torque_Nm(r.bench, 0.0)},
                  {"no_load_speed_rad_s", analysis::ideal_no_load_rad_s(r.bench)}};
  out["no_load"] = no_load(r, curve);
  out["locked"] = locked(curve.points.front());
  out["best_efficiency"] = loose(r, curve, curve.marks.best_efficiency);
  out["for_ever_from"] = loose(r, curve, curve.marks.for_ever);
  out["nominal"] = nominal(r, curve);
  out["thermal"] = curve.thermal ? stands(r, *curve.thermal) : Json(nullptr);
  out["thermal_at_worse_ends"] = curve.by_values ? Json(curve.worse_ends) : Json(nullptr);
  out["thermal_by_values"] = curve.by_values ? stands(r, *curve.by_values) : Json(nullptr);
  out["thermal_missing"] =
      curve.thermal ? Json(nullptr) : Json(motion.words(to_string(curve.thermal_missing[0])));
  if (!r.bench.motor.left_to_a_run.empty()) out["left_to_a_run"] = motion.words(r.bench.motor.left_to_a_run);
  if (const std::string bound = analysis::without_friction(r); !bound.empty())
    out["without_friction"] = motion.words(bound);
  out["points"] = Json::array();
  for (const CurveRow& row : curve_rows(r, curve)) out["points"].push_back(point(row));
  out = under_names_of(motion, out);
  return visible(out.dump(2, ' ', false, Json::error_handler_t::replace), Lines::kept) + "\n";
}

}  // namespace text

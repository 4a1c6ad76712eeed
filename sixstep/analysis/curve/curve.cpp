// SPDX-License-Identifier: Apache-2.0
#include "sixstep/analysis/curve/curve.hpp"

#include <cmath>
#include <limits>
#include <utility>

#include "sixstep/base/angle.hpp"
#include "sixstep/base/written.hpp"

namespace sixstep::analysis {
namespace {

constexpr double rad_s_per_rpm = base::pi / 30;

std::optional<double> scaled_point(const std::optional<base::Quantity>& q, double factor) {
  return q ? std::optional(q->value * factor) : std::nullopt;
}

/// Problems of the temperatures of motor and air.
base::Problems check_temperatures(const CurveRequest& r) {
  base::Problems problems;
  const std::pair<const char*, double> temperatures[] = {{"ambient_degC", r.ambient_degC},
                                                         {"winding_degC", r.motor_degC.winding_degC},
                                                         {"housing_degC", r.motor_degC.housing_degC}};
  for (const auto& [name, degC] : temperatures)  // from near absolute zero to above every winding's limit
    if (!base::between(-200, 500).holds(degC))
      problems.push_back({name, base::written(degC), "must be a temperature, -200 to 500 degC",
                          "give the temperature in degC; data sheets refer to 25"});
  if (auto lost = design::lost_magnets("housing_degC", r.sheet, r.motor_degC.housing_degC);
      problems.empty() && lost)
    problems.push_back(std::move(*lost));
  return problems;
}

}  // namespace

base::Problems check(const CurveRequest& r) {
  base::Problems problems = check_temperatures(r);
  // If the magnets have lost their magnetisation, no motor model exists that could be checked.
  if (!design::lost_magnets("housing_degC", r.sheet, r.motor_degC.housing_degC))
    for (base::Problem& p : check(r.bench)) problems.push_back(std::move(p));
  if (r.bench.duty < 0)
    problems.push_back({"duty", base::written(r.bench.duty), "must be in (0, 1]",
                        "give the duty without its sign: the backward curve is the same"});
  if (r.points < 2)
    problems.push_back({"points", std::to_string(r.points), "must be at least 2",
                        "give at least 2: standstill and no load"});
  if (r.points > most_points)
    problems.push_back({"points", std::to_string(r.points), "must be at most " + std::to_string(most_points),
                        "give fewer points; some hundred are enough for a page"});
  return problems;
}

base::Result<CurvePlan> plan_curve(const CurveRequest& r) {
  if (base::Problems problems = check(r); !problems.empty()) return problems;
  base::Result<NoLoad> end = no_load(r.bench);
  if (!end) return end.problems();
  CurvePlan plan{.no_load = *end, .speeds_rad_s = {}};
  const double highest = plan.no_load.point.speed_rad_s;
  for (int n = 0; n + 1 < r.points; ++n) plan.speeds_rad_s.push_back(n * highest / (r.points - 1));
  const std::vector<double> sweep = sweep_speeds(highest);
  plan.speeds_rad_s.insert(plan.speeds_rad_s.end(), sweep.begin(), sweep.end() - 1);
  if (const auto nominal = scaled_point(r.sheet.nominal_speed_rpm, rad_s_per_rpm))
    plan.speeds_rad_s.push_back(*nominal);
  return plan;
}

ThermalLimits thermal_limits(const design::ThermalModel& model, const CurveRequest& r, double speed) {
  const double R_tt = 2 * r.bench.motor.machine.R_ohm / design::on_R(r.motor_degC);
  const double K_t = r.bench.motor.K_t_Nm_A / design::on_K_e(r.sheet, r.motor_degC);
  const double friction = std::fabs(friction_Nm(r.bench.motor.shaft, speed));
  const double heat = friction * std::fabs(speed), sign = r.bench.duty < 0 ? -1 : 1;
  const auto torque = [&](double current, const design::Temperatures& at) {
    return sign * (design::on_K_e(r.sheet, at) * K_t * current - friction);
  };
  const auto current = [R_tt](double copper_W) {
    return copper_W > 0.0 ? std::sqrt(copper_W / R_tt) : std::numeric_limits<double>::quiet_NaN();
  };
  ThermalLimits out;
  out.continuous_A = current(design::continuous_copper_W(model, heat, r.ambient_degC));
  out.continuous_Nm = torque(out.continuous_A, design::at_the_limit(model, heat, r.ambient_degC));
  for (std::size_t n = 0; n < short_times_s.size(); ++n) {
    const double copper = design::short_time_copper_W(model, heat, r.ambient_degC, short_times_s[n]);
    out.short_A[n] = current(copper);
    out.short_Nm[n] = torque(out.short_A[n],
                             design::temperatures_after(model, {copper, heat, r.ambient_degC},
                                                        {r.ambient_degC, r.ambient_degC}, short_times_s[n]));
  }
  return out;
}

Warming warming(const design::ThermalModel& model, const CurveRequest& r, const OperatingPoint& p) {
  const design::Heating heating{p.copper_W / design::on_R(r.motor_degC), p.friction_W, r.ambient_degC};
  Warming out;
  if (const auto rest = design::steady_temperatures(model, heating)) out.winding_degC = rest->winding_degC;
  out.permissible_s = design::permissible_seconds(model, heating);
  return out;
}

std::optional<double> printed_current(const design::MotorModel& motor) {
  if (motor.nominal_current_A > 0) return motor.nominal_current_A;
  return std::nullopt;
}

/// The sources of the sheet's ratings, each once, except the data sheet itself.
std::string rated_in(const design::Sheet& sheet) {
  std::string all;
  for (const auto* rating : {&sheet.nominal_torque_mNm, &sheet.nominal_speed_rpm, &sheet.nominal_current_A}) {
    const std::string source = *rating ? (*rating)->source : std::string();
    if (source.empty() || source.starts_with("data sheet") || all.find(source) != std::string::npos) continue;
    all += (all.empty() ? "" : "; ") + source;
  }
  return all;
}

std::optional<NominalPoint> nominal_point(const CurveRequest& r, const Marks& marks,
                                          const OperatingPoint& last) {
  NominalPoint out{.speed_rad_s = scaled_point(r.sheet.nominal_speed_rpm, rad_s_per_rpm),
                   .torque_Nm = scaled_point(r.sheet.nominal_torque_mNm, 1e-3),
                   .current_A = printed_current(r.bench.motor),
                   .from = rated_in(r.sheet),
                   .at_torque = marks.nominal,
                   .at_speed = {}};
  if (out.speed_rad_s) out.at_speed = last;
  if (!out.speed_rad_s && !out.torque_Nm) return {};
  return out;
}

base::Result<Curve> curve_of(const CurveRequest& r, const CurvePlan& plan,
                             const std::vector<OperatingPoint>& found, const ForEach& for_each) {
  const auto points = static_cast<std::ptrdiff_t>(r.points) - 1;
  Curve out{.points = {found.begin(), found.begin() + points}, .no_load = plan.no_load};
  out.points.push_back(plan.no_load.point);
  std::vector<OperatingPoint> sweep(found.begin() + points, found.begin() + points + sweep_steps);
  sweep.push_back(plan.no_load.point);
  const base::Result<design::ThermalModel> model = design::safe_thermal_model(r.sheet);
  if (model)
    out.thermal = *model;
  else
    out.thermal_missing = model.problems();
  if (const auto worse = design::at_worse_ends(r.sheet)) {
    out.worse_ends = worse->values;
    out.by_values = *design::thermal_model(r.sheet);
  }
  base::Result<Marks> marks = find_marks(r.bench,
                                         {out.thermal, r.ambient_degC, design::on_R(r.motor_degC),
                                          scaled_point(r.sheet.nominal_torque_mNm, 1e-3)},
                                         sweep, for_each);
  if (!marks) return marks.problems();
  out.marks = *marks;
  out.nominal = nominal_point(r, out.marks, found.back());
  for (const OperatingPoint& p : out.points) {
    if (!out.thermal) break;
    out.limits.push_back(thermal_limits(*out.thermal, r, p.speed_rad_s));
    out.warming.push_back(warming(*out.thermal, r, p));
  }
  return out;
}

std::string without_friction(const CurveRequest& r) {
  const plant::Shaft& shaft = r.bench.motor.shaft;
  if (shaft.B_Nm_s > 0.0 || shaft.coulomb_Nm > 0.0) return "";
  return "The sheet has no friction and no iron loss, so efficiency and no-load speed are upper bounds: give its "
         "no-load speed and current, or its friction.";
}

SpeedDrop speed_drop(const CurveRequest& r, const Curve& curve) {
  const double K_t = r.bench.motor.K_t_Nm_A;
  SpeedDrop out{.ideal = 2 * r.bench.motor.machine.R_ohm / (K_t * K_t),
                .printed = scaled_point(r.sheet.speed_torque_gradient_rpm_mNm, 1e3 * rad_s_per_rpm)};
  if (!curve.nominal || !curve.nominal->torque_Nm) return out;
  const double torque = *curve.nominal->torque_Nm;
  if (r.sheet.no_load_speed_rpm && curve.nominal->speed_rad_s)
    out.sheet = (r.sheet.no_load_speed_rpm->value * rad_s_per_rpm - *curve.nominal->speed_rad_s) / torque;
  if (curve.nominal->at_torque)
    out.curve = (curve.no_load.point.speed_rad_s - curve.nominal->at_torque->speed_rad_s) / torque;
  return out;
}

}  // namespace sixstep::analysis

// SPDX-License-Identifier: Apache-2.0
#include "sixstep/study/curve/curve.hpp"

#include <cmath>

#include "sixstep/base/angle.hpp"
#include "sixstep/base/written.hpp"

namespace sixstep::study {
namespace {

constexpr double rad_s_per_rpm = base::pi / 30;

std::optional<double> scaled(const std::optional<base::Quantity>& q, double factor) {
  return q ? std::optional(q->value * factor) : std::nullopt;
}

}  // namespace

base::Problems check(const CurveRequest& r) {
  base::Problems problems = check(r.bench);
  if (r.bench.duty < 0)
    problems.push_back({"duty", base::written(r.bench.duty), "must be in (0, 1]",
                        "a curve is taken forwards: backwards it is the same"});
  if (r.points < 2)
    problems.push_back({"points", std::to_string(r.points), "must be at least 2",
                        "a curve has standstill and no load, and some points between"});
  if (r.points > most_points)
    problems.push_back({"points", std::to_string(r.points), "must be at most " + std::to_string(most_points),
                        "a page shows some hundred; each is simulated and kept"});
  // -273.15 degC, and what no winding sees.
  if (!base::between(-273.15, 1000).holds(r.ambient_degC))
    problems.push_back({"ambient_degC", base::written(r.ambient_degC), "must be a temperature in degC",
                        "25 is what data sheets mean"});
  return problems;
}

base::Result<CurvePlan> plan_curve(const CurveRequest& r) {
  if (base::Problems problems = check(r); !problems.empty()) return problems;
  base::Result<NoLoad> end = no_load(r.bench);
  if (!end) return end.problems();
  CurvePlan plan{.no_load = *end};
  const double highest = plan.no_load.point.speed_rad_s;
  for (int n = 0; n + 1 < r.points; ++n) plan.speeds_rad_s.push_back(n * highest / (r.points - 1));
  if (r.sheet.nominal_speed_rpm) {
    plan.nominal = true;
    const double sign = r.bench.duty < 0 ? -1 : 1;
    plan.speeds_rad_s.push_back(sign * r.sheet.nominal_speed_rpm->value * rad_s_per_rpm);
  }
  return plan;
}

ThermalLimits thermal_limits(const design::ThermalModel& model, const CurveRequest& r, double speed) {
  const double R_tt = 2 * r.bench.motor.machine.R_ohm, K_t = r.bench.motor.K_t_Nm_A;
  const double friction = std::fabs(friction_Nm(r.bench.motor.shaft, speed));
  const double heat = friction * std::fabs(speed), sign = r.bench.duty < 0 ? -1 : 1;
  const auto torque = [&](double current) { return sign * (K_t * current - friction); };
  ThermalLimits out;
  out.continuous_A = std::sqrt(design::continuous_copper_W(model, heat, r.ambient_degC) / R_tt);
  out.continuous_Nm = torque(out.continuous_A);
  for (std::size_t n = 0; n < short_times_s.size(); ++n) {
    out.short_A[n] =
        std::sqrt(design::short_time_copper_W(model, heat, r.ambient_degC, short_times_s[n]) / R_tt);
    out.short_Nm[n] = torque(out.short_A[n]);
  }
  return out;
}

Warming warming(const design::ThermalModel& model, const CurveRequest& r, const OperatingPoint& p) {
  const design::Heating heating{p.copper_W, p.friction_W, r.ambient_degC};
  Warming out;
  if (const auto rest = design::steady_temperatures(model, heating)) out.winding_degC = rest->winding_degC;
  out.permissible_s = design::permissible_seconds(model, heating);
  return out;
}

std::optional<double> printed_current(const design::MotorModel& motor) {
  if (motor.nominal_current_A > 0) return motor.nominal_current_A;
  return std::nullopt;
}

Curve curve_of(const CurveRequest& r, const CurvePlan& plan, const std::vector<OperatingPoint>& found) {
  Curve out{.points = found, .no_load = plan.no_load};
  if (plan.nominal) {
    const double sign = r.bench.duty < 0 ? -1 : 1;
    out.nominal = NominalPoint{plan.speeds_rad_s.back(), scaled(r.sheet.nominal_torque_mNm, sign * 1e-3),
                               printed_current(r.bench.motor), found.back()};
    out.points.pop_back();
  }
  out.points.push_back(plan.no_load.point);
  const base::Result<design::ThermalModel> model = design::thermal_model(r.sheet);
  if (!model) {
    out.thermal_missing = model.problems();
    return out;
  }
  out.thermal = *model;
  for (const OperatingPoint& p : out.points) {
    out.limits.push_back(thermal_limits(*model, r, p.speed_rad_s));
    out.warming.push_back(warming(*model, r, p));
  }
  return out;
}

}  // namespace sixstep::study

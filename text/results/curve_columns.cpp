// SPDX-License-Identifier: Apache-2.0
#include "text/results/curve_columns.hpp"

#include <fmt/format.h>

#include <array>
#include <limits>

#include "sixstep/design/sheet/thermal_ranges.hpp"

namespace text {
namespace {

constexpr double not_there = std::numeric_limits<double>::quiet_NaN();

double number(const std::optional<double>& x) { return x.value_or(not_there); }

template <double analysis::OperatingPoint::*member>
double of_point(const CurveRow& row) {
  return row.point.*member;
}
template <double analysis::ThermalLimits::*member>
double of_limits(const CurveRow& row) {
  return row.limits ? row.limits->*member : not_there;
}
template <std::size_t n>
double short_torque(const CurveRow& row) {
  return row.limits ? row.limits->short_Nm[n] : not_there;
}

using P = analysis::OperatingPoint;
static_assert(analysis::short_times_s == std::array{10.0, 60.0}, "the columns' names say so");

const std::array<CurveColumn, 25> columns = {{
    {{"speed_rad_s", "rad/s", "mechanical", "constant speed of this point"}, of_point<&P::speed_rad_s>},
    {{"torque_Nm", "N m", "shaft", "mean torque on the shaft"}, of_point<&P::shaft_torque_Nm>},
    {{"air_gap_torque_Nm", "N m", "", "mean electromagnetic torque, before friction"},
     of_point<&P::torque_Nm>},
    {{"ideal_torque_Nm", "N m", "", "torque on the straight line without commutation time and friction"},
     [](const CurveRow& row) { return analysis::ideal_torque_Nm(row.request.bench, row.point.speed_rad_s); }},
    {{"ripple_Nm", "N m", "", "electromagnetic torque, peak to peak"}, of_point<&P::ripple_Nm>},
    {{"ripple_rms_Nm", "N m", "", "electromagnetic torque about its mean, rms"}, of_point<&P::ripple_rms_Nm>},
    {{"winding_current_A", "A", "", "mean of half the sum of the phase currents' magnitudes"},
     of_point<&P::winding_current_A>},
    {{"motor_current_A", "A", "", "mean of |i_m|, the driven pair's current"}, of_point<&P::motor_current_A>},
    {{"phase_rms_A", "A", "phase", "rms of a phase current"}, of_point<&P::phase_rms_A>},
    {{"phase_peak_A", "A", "phase", "greatest phase current"}, of_point<&P::phase_peak_A>},
    {{"bus_current_A", "A", "", "mean current from the supply"}, of_point<&P::bus_current_A>},
    {{"supplied_W", "W", "", "power from the supply"}, of_point<&P::supplied_W>},
    {{"copper_W", "W", "", "loss in the winding"}, of_point<&P::copper_W>},
    {{"devices_W", "W", "", "loss in switches and diodes"}, of_point<&P::devices_W>},
    {{"friction_W", "W", "", "loss by friction"}, of_point<&P::friction_W>},
    {{"shaft_W", "W", "shaft", "power delivered by the shaft"}, of_point<&P::shaft_W>},
    {{"efficiency", "1", "", "shaft power divided by supply power; in generator operation the inverse"},
     [](const CurveRow& row) { return number(row.point.efficiency); }},
    {{"energy_residual", "1", "", "residual of the energy balance, divided by the exchanged energy"},
     of_point<&P::energy_residual>},
    {{"current_bound_A", "A", "phase", "error bound of the steady state's currents"},
     [](const CurveRow& row) {
       return row.point.orbit == analysis::Orbit::quasi_periodic ? not_there : row.point.error_bound_A;
     }},
    {{"torque_half_width_Nm", "N m", "", "half width of the mean torque's 99 % interval (chopped)"},
     of_point<&P::half_width_Nm>},
    {{"continuous_torque_Nm", "N m", "shaft",
      "torque that the winding withstands continuously, at the worse ends of thermal ranges"},
     of_limits<&analysis::ThermalLimits::continuous_Nm>},
    {{"torque_60s_Nm", "N m", "shaft",
      "torque that the winding withstands for 60 s from ambient temperature"},
     short_torque<1>},
    {{"torque_10s_Nm", "N m", "shaft",
      "torque that the winding withstands for 10 s from ambient temperature"},
     short_torque<0>},
    {{"winding_degC", "degC", "", "final temperature of the winding if the motor stays at this point"},
     [](const CurveRow& row) { return row.warming ? number(row.warming->winding_degC) : not_there; }},
    {{"permissible_s", "s", "",
      "time for which this point may last from ambient temperature; inf: unlimited"},
     [](const CurveRow& row) {
       constexpr double ever = std::numeric_limits<double>::infinity();
       return row.warming ? row.warming->permissible_s.value_or(ever) : not_there;
     }},
}};

std::vector<CurveColumn> linear_columns() {
  std::vector<CurveColumn> out(columns.begin(), columns.end());
  for (CurveColumn& c : out) {
    c.column.name = base::linear_words(c.column.name);
    c.column.unit = std::string(base::in_linear(c.column.unit).linear);
    c.column.frame = base::linear_words(c.column.frame);
    c.column.meaning = base::linear_words(c.column.meaning);
  }
  return out;
}

}  // namespace

std::span<const CurveColumn> curve_columns(const base::Motion& motion) {
  static const std::vector<CurveColumn> linear = linear_columns();
  if (motion.linear) return linear;
  return columns;
}

std::string curve_conditions(const analysis::CurveRequest& request) {
  std::string text = "the row at speed 0 without friction";
  if (!design::thermal_model(request.sheet)) return text;
  text += fmt::format("; limits and temperatures at {:g} degC ambient", request.ambient_degC);
  const std::optional<design::WorseEnds> worse = design::at_worse_ends(request.sheet);
  return worse ? text + " and the worse ends " + worse->values : text;
}

std::vector<CurveRow> curve_rows(const analysis::CurveRequest& request, const analysis::Curve& curve) {
  std::vector<CurveRow> rows;
  for (std::size_t n = 0; n < curve.points.size(); ++n)
    rows.push_back({request, curve.points[n], curve.thermal ? &curve.limits[n] : nullptr,
                    curve.thermal ? &curve.warming[n] : nullptr});
  return rows;
}

LoosePoint loose_point(const analysis::CurveRequest& request, const analysis::Curve& curve,
                       const analysis::OperatingPoint& point) {
  if (!curve.thermal) return {};
  return {analysis::thermal_limits(*curve.thermal, request, point.speed_rad_s),
          analysis::warming(*curve.thermal, request, point)};
}

CurveRow curve_row(const analysis::CurveRequest& request, const analysis::Curve& curve,
                   const analysis::OperatingPoint& point, const LoosePoint& thermal) {
  return {request, point, curve.thermal ? &thermal.limits : nullptr,
          curve.thermal ? &thermal.warming : nullptr};
}

}  // namespace text

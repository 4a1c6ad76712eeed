// SPDX-License-Identifier: Apache-2.0
#include "text/results/curve_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "sixstep/base/angle.hpp"
#include "sixstep/study/scenario/choices.hpp"
#include "text/escape/escape.hpp"

namespace text {
namespace {

constexpr std::size_t shown_points = 11;
constexpr double rpm_per_rad_s = 30 / base::pi, per_cent = 100;

/// Small motors are read in mNm, from 10 Nm of stall torque on in Nm.
struct TorqueUnit {
  double factor;
  const char* name;
};
TorqueUnit torque_unit(const analysis::Curve& curve) {
  constexpr double large_Nm = 10.0;
  return curve.points.front().shaft_torque_Nm < large_Nm ? TorqueUnit{1e3, "mNm"} : TorqueUnit{1.0, "Nm"};
}

using Row = std::vector<std::string>;

/// A fixed number of digits reads best in a column; a negative nothing is nothing.
std::string fixed(double x, int decimals) {
  std::string text = fmt::format("{:.{}f}", x, decimals);
  if (text[0] == '-' && text.find_first_not_of("-0.") == std::string::npos) text.erase(0, 1);
  return text;
}

std::string significant(double x, int digits = 5) {
  if (std::fabs(x) < 1e-9) return "0";  // a no-load point's rounding
  const int before = x == 0 ? 1 : static_cast<int>(std::floor(std::log10(std::fabs(x)))) + 1;
  return fixed(x, std::clamp(digits - before, 0, digits));
}

std::string rpm(double rad_s) { return fixed(rad_s * rpm_per_rad_s, 0); }

/// What the winding does, were the point held: a temperature, or a time.
std::string warming(const analysis::Warming& w) {
  if (!w.permissible_s) return fmt::format("{} degC", fixed(*w.winding_degC, 0));
  const double s = *w.permissible_s;
  return s < 100 ? fmt::format("{} s", significant(s, 3)) : fmt::format("{} min", fixed(s / 60, 1));
}

Row head(bool thermal, bool devices) {
  Row row = {"", "speed", "torque", "ideal", "ripple", "current", "rms", "peak", "supply", "in", "copper"};
  if (devices) row.emplace_back("devices");
  row.insert(row.end(), {"frict.", "out", "eff."});
  if (thermal) row.insert(row.end(), {"cont.", "held"});
  return row;
}

Row units(bool thermal, bool devices, const char* torque) {
  Row row = {"", "rpm", torque, torque, torque, "A", "A", "A", "A", "W", "W"};
  if (devices) row.emplace_back("W");
  row.insert(row.end(), {"W", "W", "%"});
  if (thermal) row.insert(row.end(), {torque, "winding"});
  return row;
}

class Table {
 public:
  Table(const analysis::CurveRequest& request, const analysis::Curve& curve)
      : request_(request), curve_(curve), unit_(torque_unit(curve)) {
    for (const analysis::OperatingPoint& p : curve.points) devices_ = devices_ || p.devices_W != 0;
    rows_ = {head(curve.thermal.has_value(), devices_),
             units(curve.thermal.has_value(), devices_, unit_.name)};
  }

  void add(const std::string& name, const analysis::OperatingPoint& p) {
    Row row = {name,
               rpm(p.speed_rad_s),
               significant(p.shaft_torque_Nm * unit_.factor, 4),
               significant(analysis::ideal_torque_Nm(request_.bench, p.speed_rad_s) * unit_.factor, 4),
               significant(p.ripple_Nm * unit_.factor, 3),
               significant(p.winding_current_A, 4),
               significant(p.phase_rms_A, 4),
               significant(p.phase_peak_A, 4),
               significant(p.bus_current_A, 4),
               significant(p.supplied_W, 4),
               significant(p.copper_W, 4)};
    if (devices_) row.push_back(significant(p.devices_W, 4));
    row.push_back(significant(p.friction_W, 3));
    row.push_back(significant(p.shaft_W, 4));
    row.push_back(p.efficiency ? fixed(*p.efficiency * per_cent, 1) : "-");
    if (curve_.thermal) {
      row.push_back(significant(
          analysis::thermal_limits(*curve_.thermal, request_, p.speed_rad_s).continuous_Nm * unit_.factor,
          4));
      row.push_back(warming(analysis::warming(*curve_.thermal, request_, p)));
    }
    rows_.push_back(std::move(row));
  }

  std::string text() const {
    std::vector<std::size_t> widths(rows_[0].size());
    for (const Row& row : rows_)
      for (std::size_t c = 0; c < row.size(); ++c) widths[c] = std::max(widths[c], row[c].size());
    std::string text;
    for (const Row& row : rows_) {
      std::string line = fmt::format("{:<{}}", row[0], widths[0]);
      for (std::size_t c = 1; c < row.size(); ++c) line += fmt::format("  {:>{}}", row[c], widths[c]);
      line.erase(line.find_last_not_of(' ') + 1);
      text += line + "\n";
    }
    return text;
  }

 private:
  const analysis::CurveRequest& request_;
  const analysis::Curve& curve_;
  TorqueUnit unit_;
  bool devices_ = false;
  std::vector<Row> rows_;
};

/// A rotor that is held, and the same just turning: what the angle decides is averaged there.
void add_standstill(Table& table, const analysis::OperatingPoint& turning) {
  analysis::OperatingPoint locked = turning;
  locked.shaft_torque_Nm = turning.locked->least_torque_Nm;
  locked.ripple_Nm = turning.locked->ripple_Nm;
  locked.phase_rms_A = turning.locked->phase_rms_A;
  table.add("locked", locked);
  table.add("just turning", turning);
}

/// Every k-th point, the last always.
std::string points(const analysis::CurveRequest& request, const analysis::Curve& curve) {
  Table table(request, curve);
  const std::size_t count = curve.points.size(), step = (count + shown_points - 2) / (shown_points - 1);
  add_standstill(table, curve.points.front());
  for (std::size_t n = step; n + 1 < count; n += step) table.add("", curve.points[n]);
  table.add("no load", curve.points.back());
  if (curve.marks.best_efficiency) table.add("best efficiency", *curve.marks.best_efficiency);
  if (curve.marks.nominal) table.add("nominal torque", *curve.marks.nominal);
  return table.text();
}

/// Where the angle decides the torque of a held rotor, between what.
std::string locked(const analysis::OperatingPoint& turning, TorqueUnit unit) {
  const analysis::LockedRotor& l = *turning.locked;
  if (l.greatest_torque_Nm - l.least_torque_Nm <= 1e-9 * l.greatest_torque_Nm) return "";
  return fmt::format("Locked, the angle decides: {} to {} {}; the row above has the least.\n",
                     significant(l.least_torque_Nm * unit.factor, 4),
                     significant(l.greatest_torque_Nm * unit.factor, 4), unit.name);
}

std::string no_load(const analysis::NoLoad& n) {
  const std::string unsure =
      n.half_width_rad_s > 0 ? fmt::format(" +- {}", significant(n.half_width_rad_s * rpm_per_rad_s, 2)) : "";
  return fmt::format(
      "No load: {}{} rpm ({} rad/s) with {} A through the winding, {} A from the supply; a rotor let free "
      "ran at {} rpm ({} s simulated{}).\n",
      significant(n.point.speed_rad_s * rpm_per_rad_s), unsure, significant(n.point.speed_rad_s, 6),
      significant(n.point.winding_current_A, 4), significant(n.point.bus_current_A, 4),
      significant(n.free_speed_rad_s * rpm_per_rad_s), significant(n.free_s, 2),
      n.settled ? ""
                : fmt::format(", short of 20 time constants of {} s", significant(n.time_constant_s, 2)));
}

std::string ideal(const analysis::Bench& b, TorqueUnit unit) {
  return fmt::format(
      "Ideal line, without commutation time and friction: {} {} at standstill, {} rpm without load.\n",
      significant(analysis::ideal_torque_Nm(b, 0.0) * unit.factor), unit.name,
      significant(analysis::ideal_no_load_rad_s(b) * rpm_per_rad_s));
}

/// "-12.0 %": how far from what the sheet prints.
std::string against(double here, double sheet) {
  return fmt::format("{:+.1f} %", per_cent * (here / sheet - 1));
}

/// What the sheet's gradient does not say: it is the ideal line's.
std::string drop(const analysis::CurveRequest& r, const analysis::Curve& curve, TorqueUnit unit) {
  const analysis::SpeedDrop d = analysis::speed_drop(r, curve);
  const auto per_torque = [&](double x) { return significant(x * rpm_per_rad_s / unit.factor, 3); };
  std::string text = fmt::format("From no load to that torque the curve falls by {} rpm/{}",
                                 per_torque(*d.curve), unit.name);
  if (d.sheet) text += fmt::format(", the sheet's own two points by {}", per_torque(*d.sheet));
  text += fmt::format("; R/K_t^2 is {}", per_torque(d.ideal));
  if (d.printed) text += fmt::format(" (printed as gradient: {})", per_torque(*d.printed));
  return text + " and leaves out the time that commutation takes.\n";
}

/// Compared only where the curve is of the voltage that the sheet's point belongs to, and at the torque: the
/// load asks for that, the speed is the motor's answer.
std::string nominal(const analysis::CurveRequest& r, const analysis::Curve& curve, TorqueUnit unit) {
  const analysis::NominalPoint& n = *curve.nominal;
  std::string text = "Nominal point of the sheet:";
  const auto item = [&](const std::string& what) { text += (text.back() == ':' ? " " : ", ") + what; };
  if (n.torque_Nm) item(fmt::format("{} {}", significant(*n.torque_Nm * unit.factor, 4), unit.name));
  if (n.speed_rad_s) item(rpm(*n.speed_rad_s) + " rpm");
  if (n.current_A) item(significant(*n.current_A, 4) + " A");
  const double sheet_V = r.bench.motor.nominal_voltage_V;
  if (r.bench.duty != 1 || r.bench.voltage_V != sheet_V)
    return text + fmt::format(", at full duty and {:g} V.\n", sheet_V);
  if (!n.torque_Nm) return text + "; without a torque it is no point of the curve.\n";
  if (!n.at_torque) return text + "; the curve never has that torque.\n";
  const analysis::OperatingPoint& p = *n.at_torque;
  text += fmt::format("; at that torque the curve has {} rpm", rpm(p.speed_rad_s));
  if (n.speed_rad_s) text += fmt::format(" ({})", against(p.speed_rad_s, *n.speed_rad_s));
  text += fmt::format(" and {} A", significant(p.winding_current_A, 4));
  if (n.current_A) text += fmt::format(" ({})", against(p.winding_current_A, *n.current_A));
  return text + ".\n" + drop(r, curve, unit);
}

/// Where the winding stands the curve itself.
std::string lasting(const analysis::Curve& curve, TorqueUnit unit) {
  if (!curve.marks.for_ever) return "Not even no load can be held for ever.\n";
  const analysis::OperatingPoint& from = *curve.marks.for_ever;
  return fmt::format("The curve itself can be held for ever from {} rpm ({} {}) on.\n", rpm(from.speed_rad_s),
                     significant(from.shaft_torque_Nm * unit.factor, 4), unit.name);
}

std::string thermal(const analysis::CurveRequest& r, const analysis::Curve& curve, TorqueUnit unit) {
  if (!curve.thermal) return fmt::format("No thermal limits: {}.\n", to_string(curve.thermal_missing[0]));
  const analysis::ThermalLimits still = analysis::thermal_limits(*curve.thermal, r, 0.0);
  std::string text = fmt::format(
      "At {:g} degC ambient the winding stays below {:g} degC with {} A ({} {} at standstill) for ever, {} "
      "A for {} s, {} A for {} s.\n",
      r.ambient_degC, curve.thermal->max_winding_degC, significant(still.continuous_A, 3),
      significant(still.continuous_Nm * unit.factor, 4), unit.name, significant(still.short_A[1], 3),
      analysis::short_times_s[1], significant(still.short_A[0], 3), analysis::short_times_s[0]);
  return text + lasting(curve, unit);
}

std::string certainty(const analysis::Curve& curve, TorqueUnit unit) {
  double bound = 0.0, residual = 0.0, width = 0.0;
  bool precise = true;
  for (const analysis::OperatingPoint& p : curve.points) {
    bound = std::max(bound, p.error_bound_A);
    residual = std::max(residual, std::fabs(p.energy_residual));
    width = std::max(width, p.half_width_Nm);
    precise = precise && p.precise;
  }
  std::string text = curve.no_load.point.orbit == analysis::Orbit::quasi_periodic
                         ? fmt::format("Mean torque within +- {} {} at {} % ({} batches)",
                                       significant(width * unit.factor, 2), unit.name,
                                       per_cent * analysis::confidence_level, analysis::batches)
                         : fmt::format("Steady currents within {:.1g} A", bound);
  if (!precise) text += ", at some points less narrow than wanted";
  return text + fmt::format("; the energy balance closes to {:.1g}.\n", residual);
}

}  // namespace

std::string curve_table(const analysis::CurveRequest& r, const analysis::Curve& curve) {
  const analysis::Bench& b = r.bench;
  std::string text = fmt::format("{} at {:g} V", visible(r.sheet.name), b.voltage_V);
  if (std::fabs(b.duty) != 1)
    text += fmt::format(", duty {:g}, {} chopping, PWM period {:g} us", b.duty,
                        base::word(study::chopping_choices, b.chopping), b.pwm_period_s * 1e6);
  text += "\n";
  const TorqueUnit unit = torque_unit(curve);
  text += points(r, curve) + locked(curve.points.front(), unit) + ideal(b, unit) + no_load(curve.no_load);
  if (curve.nominal) text += nominal(r, curve, unit);
  return text + thermal(r, curve, unit) + certainty(curve, unit);
}

}  // namespace text

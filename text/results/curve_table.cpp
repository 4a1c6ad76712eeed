// SPDX-License-Identifier: Apache-2.0
#include "text/results/curve_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "sixstep/base/angle.hpp"
#include "sixstep/design/sheet/motion.hpp"
#include "sixstep/study/scenario/choices.hpp"
#include "text/escape/escape.hpp"

namespace text {
namespace {

constexpr std::size_t shown_points = 11;
constexpr double per_cent = 100;

/// The units of speeds and torques, and factors from rad/s and N m.
struct Units {
  struct Unit {
    double factor;
    const char* name;
    int decimals;  ///< decimals of a speed in a column
  };
  Unit speed, torque;
  base::Motion motion;
};

/// Small motors are shown in mNm, motors with a stall torque of 10 Nm or more in Nm.
Units units_of(const analysis::CurveRequest& r, const analysis::Curve& curve) {
  constexpr double large_Nm = 10.0;
  const base::Motion motion = design::motion_of(r.sheet);
  if (motion.linear) return {{1.0, "m/s", 3}, {1.0, "N", 0}, motion};
  const bool small = curve.points.front().shaft_torque_Nm < large_Nm;
  return {{30 / base::pi, "rpm", 0}, small ? Units::Unit{1e3, "mNm", 0} : Units::Unit{1.0, "Nm", 0}, motion};
}

using Row = std::vector<std::string>;

/// A fixed number of digits for a column; a negative zero becomes 0.
std::string fixed(double x, int decimals) {
  std::string text = fmt::format("{:.{}f}", x, decimals);
  if (text[0] == '-' && text.find_first_not_of("-0.") == std::string::npos) text.erase(0, 1);
  return text;
}

std::string significant(double x, int digits = 5) {
  if (std::isnan(x)) return "none";
  if (std::fabs(x) < 1e-9) return "0";  // rounding at a no-load point
  const int before = x == 0 ? 1 : static_cast<int>(std::floor(std::log10(std::fabs(x)))) + 1;
  return fixed(x, std::clamp(digits - before, 0, digits));
}

std::string speed(double rad_s, const Units& u) { return fixed(rad_s * u.speed.factor, u.speed.decimals); }
/// The speed with its unit: "5016 rpm".
std::string speed_text(double rad_s, const Units& u) {
  return fmt::format("{} {}", speed(rad_s, u), u.speed.name);
}
std::string torque_text(double Nm, const Units& u, int digits = 4) {
  return fmt::format("{} {}", significant(Nm * u.torque.factor, digits), u.torque.name);
}

/// The thermal result of a point at which the motor stays: a final temperature, or a permissible time.
std::string warming(const analysis::Warming& w) {
  if (!w.permissible_s) return fmt::format("{} degC", fixed(*w.winding_degC, 0));
  const double s = *w.permissible_s;
  return s < 100 ? fmt::format("{} s", significant(s, 3)) : fmt::format("{} min", fixed(s / 60, 1));
}

Row head(bool thermal, bool devices, const base::Motion& motion) {
  Row row = {"",   "speed", motion.words("torque"), "ideal", "ripple", "current", "rms", "peak", "supply",
             "in", "copper"};
  if (devices) row.emplace_back("devices");
  row.insert(row.end(), {"frict.", "out", "eff."});
  if (thermal) row.insert(row.end(), {"cont.", "held"});
  return row;
}

Row units(bool thermal, bool devices, const Units& u) {
  const char* const torque = u.torque.name;
  Row row = {"", u.speed.name, torque, torque, torque, "A", "A", "A", "A", "W", "W"};
  if (devices) row.emplace_back("W");
  row.insert(row.end(), {"W", "W", "%"});
  if (thermal) row.insert(row.end(), {torque, "winding"});
  return row;
}

class Table {
 public:
  Table(const analysis::CurveRequest& request, const analysis::Curve& curve)
      : request_(request), curve_(curve), units_(units_of(request, curve)) {
    for (const analysis::OperatingPoint& p : curve.points) devices_ = devices_ || p.devices_W != 0;
    rows_ = {head(curve.thermal.has_value(), devices_, units_.motion),
             units(curve.thermal.has_value(), devices_, units_)};
  }

  void add(const std::string& name, const analysis::OperatingPoint& p) {
    const double torque = units_.torque.factor;
    Row row = {units_.motion.words(name),
               speed(p.speed_rad_s, units_),
               significant(p.shaft_torque_Nm * torque, 4),
               significant(analysis::ideal_torque_Nm(request_.bench, p.speed_rad_s) * torque, 4),
               significant(p.ripple_Nm * torque, 3),
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
          analysis::thermal_limits(*curve_.thermal, request_, p.speed_rad_s).continuous_Nm * torque, 4));
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
  Units units_;
  bool devices_ = false;
  std::vector<Row> rows_;
};

/// Two rows: a rotor held at one angle, and a rotor that just begins to turn, with the torque averaged over
/// the angle.
void add_standstill(Table& table, const analysis::OperatingPoint& turning) {
  analysis::OperatingPoint locked = turning;
  locked.shaft_torque_Nm = turning.locked->least_torque_Nm;
  locked.ripple_Nm = turning.locked->ripple_Nm;
  locked.phase_rms_A = turning.locked->phase_rms_A;
  table.add("locked", locked);
  table.add("just turning", turning);
}

/// Every k-th point of the curve, always the last point, and the marked points.
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

/// The range of a held rotor's torque, if it depends on the angle.
std::string locked(const analysis::OperatingPoint& turning, const Units& u) {
  const analysis::LockedRotor& l = *turning.locked;
  if (l.greatest_torque_Nm - l.least_torque_Nm <= 1e-9 * l.greatest_torque_Nm) return "";
  return fmt::format(
      "Locked rotor: {} to {} {}, depending on the angle; the row above has the least torque.\n",
      significant(l.least_torque_Nm * u.torque.factor, 4),
      significant(l.greatest_torque_Nm * u.torque.factor, 4), u.torque.name);
}

std::string left_out(const analysis::Bench& b) {
  const std::string& words = b.motor.left_to_a_run;
  return words.empty() ? "" : fmt::format("This curve neglects effects that a run simulates: {}.\n", words);
}

std::string no_load(const analysis::NoLoad& n, const Units& u) {
  const double per_rad_s = u.speed.factor;
  const std::string unsure =
      n.half_width_rad_s > 0 ? fmt::format(" +- {}", significant(n.half_width_rad_s * per_rad_s, 2)) : "";
  const std::string in_si =
      u.motion.linear ? "" : fmt::format(" ({} rad/s)", significant(n.point.speed_rad_s, 6));
  return fmt::format(
      "No load: {}{} {}{} with {} A through the winding and {} A from the supply. A free rotor reached {} {} ({} s simulated{}).\n",
      significant(n.point.speed_rad_s * per_rad_s), unsure, u.speed.name, in_si,
      significant(n.point.winding_current_A, 4), significant(n.point.bus_current_A, 4),
      significant(n.free_speed_rad_s * per_rad_s), u.speed.name, significant(n.free_s, 2),
      n.settled ? ""
                : fmt::format(", less than 22 time constants of {} s", significant(n.time_constant_s, 2)));
}

std::string ideal(const analysis::Bench& b, const Units& u) {
  return fmt::format(
      "Ideal line, without commutation time and friction: {} at standstill, {} {} without load.\n",
      torque_text(analysis::ideal_torque_Nm(b, 0.0), u, 5),
      significant(analysis::ideal_no_load_rad_s(b) * u.speed.factor), u.speed.name);
}

/// The difference from the sheet's value: "-12.0 %".
std::string against(double here, double sheet) {
  return fmt::format("{:+.1f} %", per_cent * (here / sheet - 1));
}

/// The curve's speed drop. The sheet's gradient is only the gradient of the ideal line.
std::string drop(const analysis::CurveRequest& r, const analysis::Curve& curve, const Units& u) {
  const analysis::SpeedDrop d = analysis::speed_drop(r, curve);
  const auto per_torque = [&](double x) { return significant(x * u.speed.factor / u.torque.factor, 3); };
  std::string text = fmt::format("From no load to the nominal torque the curve falls by {} {}/{}",
                                 per_torque(*d.curve), u.speed.name, u.torque.name);
  if (d.sheet)
    text += fmt::format(", and between the sheet's no-load and nominal points by {}", per_torque(*d.sheet));
  text += fmt::format("; R/K_t^2 is {}", per_torque(d.ideal));
  if (d.printed) text += fmt::format(" (printed as gradient: {})", per_torque(*d.printed));
  return text + ", which neglects the commutation time.\n";
}

/// The comparison with the sheet's nominal point, if the curve has that point's voltage. The values are
/// compared at the point's torque, because the load determines the torque, and the motor the speed.
std::string nominal(const analysis::CurveRequest& r, const analysis::Curve& curve, const Units& u) {
  const analysis::NominalPoint& n = *curve.nominal;
  std::string text =
      n.from.empty() ? "Nominal point of the sheet:" : "Nominal point, " + visible(n.from) + ":";
  const auto item = [&](const std::string& what) { text += (text.back() == ':' ? " " : ", ") + what; };
  if (n.torque_Nm) item(torque_text(*n.torque_Nm, u));
  if (n.speed_rad_s) item(speed_text(*n.speed_rad_s, u));
  if (n.current_A) item(significant(*n.current_A, 4) + " A");
  const double sheet_V = r.bench.motor.nominal_voltage_V;
  if (r.bench.duty != 1 || r.bench.voltage_V != sheet_V)
    return text + fmt::format(", at full duty and {:g} V.\n", sheet_V);
  if (!n.torque_Nm)
    return text + "; the sheet gives no nominal torque, so the curve cannot be compared with this point.\n";
  if (!n.at_torque) return text + "; the curve does not reach the nominal torque.\n";
  const analysis::OperatingPoint& p = *n.at_torque;
  text += fmt::format("; at this torque the curve has {}", speed_text(p.speed_rad_s, u));
  if (n.speed_rad_s) text += fmt::format(" ({})", against(p.speed_rad_s, *n.speed_rad_s));
  text += fmt::format(" and {} A", significant(p.winding_current_A, 4));
  if (n.current_A) text += fmt::format(" ({})", against(p.winding_current_A, *n.current_A));
  return text + ".\n" + drop(r, curve, u);
}

/// The part of the curve that the winding withstands continuously.
std::string lasting(const analysis::Curve& curve, const Units& u) {
  if (!curve.marks.for_ever) return "Even without load the winding becomes too hot.\n";
  const analysis::OperatingPoint& from = *curve.marks.for_ever;
  return fmt::format("The motor can run continuously on this curve from {} ({}) on.\n",
                     speed_text(from.speed_rad_s, u), torque_text(from.shaft_torque_Nm, u));
}

/// The currents that the winding withstands at standstill.
std::string stands(const std::string& when, const design::ThermalModel& model,
                   const analysis::CurveRequest& r, const Units& u) {
  const analysis::ThermalLimits l = analysis::thermal_limits(model, r, 0.0);
  if (std::isnan(l.continuous_A))
    return fmt::format("{} the winding is above {:g} degC without any current.\n", when,
                       model.max_winding_degC);
  return fmt::format(
      "{} the winding stays below {:g} degC with {} A ({} at standstill) continuously, {} A for {} s, {} A for {} s.\n",
      when, model.max_winding_degC, significant(l.continuous_A, 3), torque_text(l.continuous_Nm, u),
      significant(l.short_A[1], 3), analysis::short_times_s[1], significant(l.short_A[0], 3),
      analysis::short_times_s[0]);
}

/// A warning of speeds that the motor's constants allow, but not its mechanics.
std::string too_fast(const analysis::CurveRequest& r, const analysis::Curve& curve, const Units& u) {
  if (!r.sheet.max_speed_rpm) return "";
  const double allowed = r.sheet.max_speed_rpm->value / base::rpm_per_rad_s;
  const auto past = [&](const std::optional<analysis::OperatingPoint>& p) {
    return p && p->speed_rad_s > allowed;
  };
  const double fastest = curve.no_load.point.speed_rad_s;
  if (!(fastest > allowed)) return "";
  std::string text = fmt::format("The sheet's speed limit is {}, but the no-load speed is {}",
                                 speed_text(allowed, u), speed_text(fastest, u));
  if (past(curve.marks.best_efficiency))
    text += fmt::format(", and the best efficiency is at {}",
                        speed_text(curve.marks.best_efficiency->speed_rad_s, u));
  return text + ": points above the sheet's speed limit are not operating points.\n";
}

std::string thermal(const analysis::CurveRequest& r, const analysis::Curve& curve, const Units& u) {
  if (!curve.thermal) return fmt::format("No thermal limits: {}.\n", to_string(curve.thermal_missing[0]));
  std::string when = fmt::format("At {:g} degC ambient", r.ambient_degC);
  if (!curve.by_values) return stands(when, *curve.thermal, r, u) + lasting(curve, u);
  when += fmt::format(" and the worse ends of the motor file's ranges ({})", curve.worse_ends);
  return stands(when, *curve.thermal, r, u) + lasting(curve, u) +
         "All these limits, and the columns cont. and held, use the worse ends of the ranges.\n" +
         stands("With the motor file's values themselves", *curve.by_values, r, u);
}

std::string certainty(const analysis::Curve& curve, const Units& u) {
  double bound = 0.0, residual = 0.0, width = 0.0;
  bool precise = true;
  for (const analysis::OperatingPoint& p : curve.points) {
    bound = std::max(bound, p.error_bound_A);
    residual = std::max(residual, std::fabs(p.energy_residual));
    width = std::max(width, p.half_width_Nm);
    precise = precise && p.precise;
  }
  std::string text =
      curve.no_load.point.orbit == analysis::Orbit::quasi_periodic
          ? fmt::format("Mean torque within +- {} at {} % ({} batches)", torque_text(width, u, 2),
                        per_cent * analysis::confidence_level, analysis::batches)
          : fmt::format("Steady currents within {:.1g} A", bound);
  if (!precise) text += ", at some points less exactly than requested";
  return text + fmt::format("; the energy balance closes to {:.1g}.\n", residual);
}

}  // namespace

std::string curve_table(const analysis::CurveRequest& r, const analysis::Curve& curve) {
  const analysis::Bench& b = r.bench;
  std::string text = fmt::format("{} at {:g} V", visible(r.sheet.name), b.voltage_V);
  if (std::fabs(b.duty) != 1)
    text += fmt::format(", duty {:g}, {} chopping, PWM period {:g} us", b.duty,
                        base::word(study::chopping_choices, b.chopping), b.pwm_period_s * 1e6);
  if (design::on_R(r.motor_degC) != 1 || design::on_K_e(r.sheet, r.motor_degC) != 1)
    text += fmt::format(", winding at {:g} degC, magnets at {:g} degC", r.motor_degC.winding_degC,
                        r.motor_degC.housing_degC);
  text += "\n";
  const Units u = units_of(r, curve);
  std::string words = locked(curve.points.front(), u) + ideal(b, u) + no_load(curve.no_load, u);
  if (curve.nominal) words += nominal(r, curve, u);
  if (const std::string bound = analysis::without_friction(r); !bound.empty()) words += bound + "\n";
  words += thermal(r, curve, u) + too_fast(r, curve, u) + certainty(curve, u) + left_out(b);
  return text + points(r, curve) + u.motion.words(words);
}

}  // namespace text

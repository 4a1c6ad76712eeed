// SPDX-License-Identifier: Apache-2.0
#include "sixstep/study/run/export_protection.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>

#include "sixstep/base/decimal.hpp"
#include "sixstep/base/written.hpp"
#include "sixstep/design/sheet/thermal_ranges.hpp"
#include "sixstep/study/check/product.hpp"
#include "sixstep/study/measure/winding_watch.hpp"
#include "sixstep/study/scenario/reference_waveform.hpp"
#include "sixstep/study/scenario/supply_voltages.hpp"

namespace sixstep::study {
namespace {

using base::written;
using control::Mode;

/// An over-speed threshold above this multiple of the no-load speed does not protect: no usual load drives a
/// rotor that fast.
constexpr double beyond_no_load = 2.0;

std::string rounded_down(double x) { return written(base::shortened(x, 2, base::Towards::down)); }

}  // namespace

std::optional<MostCurrent> most_current(const Scenario& s, const design::MotorModel& motor) {
  if (s.control.mode == Mode::current) {
    double most = 0.0;
    for (const Level& level : reference_levels(s)) most = std::max(most, std::fabs(level.value));
    if (most == 0.0) return std::nullopt;
    return MostCurrent{most, "the reference"};
  }
  const std::optional<double> limit = current_limit_A(s);
  if (!limit) return std::nullopt;
  const Limits& bounds = s.control.limits;
  const double by_current_A = bounds.current_A.value_or(*limit);
  const double by_torque_A = bounds.torque_Nm ? *bounds.torque_Nm / motor.K_t_Nm_A : *limit;
  if (by_torque_A < std::min(*limit, by_current_A))
    return MostCurrent{by_torque_A, "control.limits.torque_Nm divided by K_t"};
  if (by_current_A < *limit) return MostCurrent{by_current_A, "control.limits.current_A"};
  return MostCurrent{*limit, s.control.current.limit_A == limit ? "control.current.limit_A"
                             : s.control.speed.torque_limit_Nm
                                 ? "control.speed.torque_limit_Nm divided by K_t"
                                 : "the usual torque limit divided by K_t"};
}

base::Result<design::WithstandTimes> withstand_times_of(const Scenario& s, const design::MotorModel& motor,
                                                        const MostCurrent& most) {
  const double copper_W = 2 * motor.machine.R_ohm * most.ampere * most.ampere;
  return design::withstand_times(
      s.sheet, {.copper_W = copper_W, .housing_W = 0.0, .ambient_degC = s.heat.ambient_degC},
      start_temperatures(s.heat));
}

namespace {

void look_at_stalling(const Scenario& s, const MostCurrent& most, base::Problems& out) {
  const Protection& p = s.protection;
  // A current at the limit may be read lower by two counts of the converter and by 2 % for ripple and noise.
  const double count_A = s.sensors.current_range_A.value_or(0.0) * 2 / std::ldexp(1.0, s.sensors.adc_bits);
  const double surely_A = 0.98 * most.ampere - 2 * count_A;
  if (!p.stall_current_A || *p.stall_current_A <= surely_A) return;
  const bool coarse = 2 * count_A > 0.1 * most.ampere;
  const std::string limited = "may never be exceeded: the current is limited to " +
                              base::three_digits(most.ampere) + " A, " + most.by;
  const std::string counted =
      ", and the converter resolves it to two counts of " + base::three_digits(count_A) + " A";
  const std::string finer = "raise sensors.adc_bits, or lower sensors.current_range_A";
  const double lower_A = std::min(0.8 * most.ampere, surely_A);
  out.push_back(
      {"protection.stall_current_A", written(*p.stall_current_A), coarse ? limited + counted : limited,
       lower_A > 0
           ? "lower this value, for example to " + rounded_down(lower_A) + (coarse ? ", or " + finer : "")
           : finer});
}

/// Refuses a threshold that would stop a drive in normal operation.
void look_at_over_current(const Scenario& s, const MostCurrent& most, base::Problems& out) {
  const std::optional<double>& over_A = s.protection.over_current_A;
  if (!over_A || *over_A > most.ampere) return;
  out.push_back({"protection.over_current_A", written(*over_A),
                 "stops the drive at a current that the drive's limits allow: " +
                     base::three_digits(most.ampere) + " A, " + most.by,
                 "raise this value above this current plus the ripple, or lower the current limit"});
}

/// A blocked rotor: two phases carry the current, and friction does not heat the motor.
void look_at_stall_time(const Scenario& s, const design::MotorModel& motor, const MostCurrent& most,
                        base::Problems& out) {
  if (!s.protection.stall_s) return;
  const auto times = withstand_times_of(s, motor, most);
  if (!times || !times->by_worse_ends || *s.protection.stall_s <= *times->by_worse_ends) return;
  std::string within = base::three_digits(*times->by_worse_ends) + " s";
  if (times->differ())
    within += " by the worse ends of the motor file's thermal ranges, " +
              (times->by_values ? "within " + base::three_digits(*times->by_values) + " s" : "never") +
              " by the values themselves";
  out.push_back({"protection.stall_s", written(*s.protection.stall_s),
                 "is longer than the winding withstands a stall: " + base::three_digits(most.ampere) +
                     " A, " + most.by + ", heats it to " + base::three_digits(times->worse_limit_degC) +
                     " degC within " + within,
                 "shorten this value, for example to " + rounded_down(0.5 * *times->by_worse_ends)});
}

void look_at_over_speed(const Scenario& s, const design::MotorModel& motor, base::Problems& out) {
  const std::optional<double>& over = s.protection.over_speed_rad_s;
  double fastest = beyond_no_load * highest_open_V(s) / motor.K_t_Nm_A;
  for (const Level& level : reference_levels(s))
    if (s.control.mode == Mode::speed) fastest = std::max(fastest, beyond_no_load * std::fabs(level.value));
  if (!over || *over <= fastest) return;
  out.push_back({"protection.over_speed_rad_s", written(*over),
                 "protects nothing: without a load the bus turns the motor at " +
                     base::three_digits(highest_open_V(s) / motor.K_t_Nm_A) +
                     " rad/s, and the threshold is above " + base::three_digits(beyond_no_load) +
                     " times that speed (" + base::three_digits(fastest) + " rad/s)",
                 "lower this value to the highest speed that motor and machine withstand"});
}

/// With an accepted offset, the converter must still show the over-current threshold in both directions.
void look_at_offset(const Scenario& s, base::Problems& out) {
  const std::optional<double>&tolerance_A = s.protection.offset_tolerance_A,
        &range_A = s.sensors.current_range_A;
  if (!tolerance_A || !range_A || s.sensors.currents == rig::CurrentMeasurement::ideal) return;
  const double seen_A = *range_A / 2, over_A = s.protection.over_current_A.value_or(seen_A);
  const double most_A = std::min(seen_A, *range_A - over_A);
  if (*tolerance_A <= most_A) return;
  const bool by_half = seen_A <= *range_A - over_A;
  out.push_back(
      {"protection.offset_tolerance_A", written(*tolerance_A),
       "accepts a faulty sensor: with this offset the converter measures only up to " +
           base::three_digits(*range_A - *tolerance_A) + " A in one direction" +
           (by_half ? ", less than half of sensors.current_range_A = " + written(*range_A)
                    : ", and protection.over_current_A = " + written(over_A) + " is not exceeded there"),
       "lower this value to " + rounded_down(most_A) + " at most; 2 % of the range are usual"});
}

}  // namespace

void look_at_protection(const Scenario& s, const design::MotorModel& motor, base::Problems& out) {
  if (const std::optional<MostCurrent> most = most_current(s, motor)) {
    look_at_over_current(s, *most, out);
    look_at_stalling(s, *most, out);
    look_at_stall_time(s, motor, *most, out);
  }
  look_at_offset(s, out);
  look_at_over_speed(s, motor, out);
}

}  // namespace sixstep::study

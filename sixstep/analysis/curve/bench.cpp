// SPDX-License-Identifier: Apache-2.0
#include "sixstep/analysis/curve/bench.hpp"

#include <cmath>
#include <string>

#include "sixstep/base/range_text.hpp"
#include "sixstep/base/written.hpp"
#include "sixstep/plant/pace.hpp"

namespace sixstep::analysis {

namespace {

/// Largest number of control periods in the settling time of a point with chopping (operating_point.cpp).
/// Each run of such a point takes some seconds.
constexpr double most_periods = 1e6;

/// Least duty, corresponding to a pulse of 30 ps in 30 us.
constexpr double least_duty = 1e-6;

/// Adds problems for values that are allowed individually, but together take too long to simulate.
void check_pace(const Bench& b, base::Problems& problems) {
  const plant::Machine& m = b.motor.machine;
  const auto refuse = [&](const char* where, double value, const std::string& limit, const char* cure) {
    problems.push_back({where, base::written(value), limit, cure});
  };
  if (plant::field_at(m, b.voltage_V) > plant::fastest_field_rad_s)
    refuse("voltage_V", b.voltage_V,
           "turns the field at " + base::rounded(plant::field_at(m, b.voltage_V), 3) +
               " electrical rad/s, and no motor reaches more than " +
               base::rounded(plant::fastest_field_rad_s, 3),
           "give a lower voltage, or correct the unit of the torque constant in the motor file");
  if (plant::winding_rate(m, b.devices) > plant::fastest_answer_1_s)
    refuse("on_resistance_ohm", b.devices.R_on_ohm, "gives winding and bridge a time constant below 100 ns",
           "correct the unit of this value: a MOSFET has milliohms");
  const bool chops = b.duty != 1 && b.duty != -1;
  if (chops && m.L_H / m.R_ohm > most_periods * b.pwm_period_s)
    refuse("pwm_period_s", b.pwm_period_s,
           "is less than a millionth of the winding's time constant, " + base::rounded(m.L_H / m.R_ohm, 3) +
               " s",
           "give the PWM period in seconds, as 50e-6 for 20 kHz");
}

}  // namespace

base::Problems check(const Bench& b) {
  base::Problems problems;
  const auto hold = [&](const char* where, double x, const base::Range& own, std::string_view unit,
                        const char* cure) {
    append(problems, base::out_of_range(where, x, own, unit, cure));
  };
  hold("voltage_V", b.voltage_V, base::above(0), "V", "give the bus voltage in volts");
  if (!(base::between(-1, 1).holds(b.duty) && std::fabs(b.duty) >= least_duty))
    problems.push_back({"duty", base::written(b.duty), "must be in (0, 1]",
                        "give a duty of 1e-6 to 1; 1 is the full voltage"});
  hold("pwm_period_s", b.pwm_period_s, {0, 1, false, true}, "s",
       "give the PWM period in seconds, as 50e-6 for 20 kHz");
  hold("on_resistance_ohm", b.devices.R_on_ohm, base::from(0), "ohm",
       "give the switches' resistance in ohms");
  hold("diode_drop_V", b.devices.V_f_V, base::from(0), "V", "give the diodes' forward voltage in volts");
  hold("diode_resistance_ohm", b.devices.r_d_ohm, base::from(0), "ohm",
       "give the diodes' resistance in ohms");
  if (problems.empty()) check_pace(b, problems);
  return problems;
}

}  // namespace sixstep::analysis

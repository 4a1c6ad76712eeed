// SPDX-License-Identifier: Apache-2.0
#include "sixstep/design/loops/wish_check.hpp"

#include <string>

#include "sixstep/base/written.hpp"

namespace sixstep::design {

using control::Mode;

base::Problems check_wish(const MotorModel& motor, const DesignWish& w) {
  base::Problems found;
  const auto add = [&](const char* where, const std::string& value, const char* limit, const char* cure) {
    found.push_back({where, value, limit, cure});
  };
  const auto above_0 = [](double x) { return x > 0.0 && x - x == 0.0; };
  if (w.mode != Mode::current && w.mode != Mode::speed && w.mode != Mode::position)
    add("--mode", "", "must be current, speed or position", "choose what is to be controlled");
  if (w.method == GainMethod::symmetrical_optimum && w.mode == Mode::current)
    add("--method", "symmetrical-optimum", "is a rule for speed loops",
        "add --mode speed, or take pole-placement or cancellation");
  if (w.delay_periods < 0 || w.delay_periods > 1)
    add("--delay", std::to_string(w.delay_periods), "must be 0 or 1",
        "0: a command counts at once, 1: from the next period on");
  if (w.bandwidth_rad_s && w.method == GainMethod::pole_placement)
    add("--bandwidth", base::written(*w.bandwidth_rad_s), "is no input of pole placement",
        "give --settle, or take --method cancellation");
  if (w.bandwidth_rad_s && !above_0(*w.bandwidth_rad_s))
    add("--bandwidth", base::written(*w.bandwidth_rad_s), "must be above 0", "give it in rad/s");
  if (w.voltage_V && !above_0(*w.voltage_V))
    add("--voltage", base::written(*w.voltage_V), "must be above 0", "give the bus voltage in volts");
  if (!w.voltage_V && !above_0(motor.nominal_voltage_V))
    add("--voltage", "", "is missing, and the sheet prints no nominal voltage",
        "give the bus voltage in volts");
  if (!above_0(w.period_s))
    add("--period", base::written(w.period_s), "must be above 0", "give the control period in seconds");
  if (w.torque_limit_Nm && !above_0(*w.torque_limit_Nm))
    add("--torque-limit", base::written(*w.torque_limit_Nm), "must be above 0", "give it in N m");
  if (w.lowest_speed_rad_s && !above_0(*w.lowest_speed_rad_s))
    add("--lowest-speed", base::written(*w.lowest_speed_rad_s), "must be above 0", "give it in rad/s");
  if (w.rotor.edges < 0 || w.rotor.edges > 6)
    add("--edges", std::to_string(w.rotor.edges), "must lie in 1 to 6", "leave it out to have them adaptive");
  if (!(w.load_inertia_kg_m2 >= 0.0 && w.load_inertia_kg_m2 - w.load_inertia_kg_m2 == 0.0))
    add("--load-inertia", base::written(w.load_inertia_kg_m2), "must not be negative", "give it in kg m2");
  return found;
}

}  // namespace sixstep::design

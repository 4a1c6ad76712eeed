// SPDX-License-Identifier: Apache-2.0
#include "sixstep/design/loops/spec_check.hpp"

#include <optional>
#include <string>
#include <string_view>

#include "sixstep/base/range_text.hpp"
#include "sixstep/base/written.hpp"

namespace sixstep::design {

using control::Mode;

double most_lowest_speed_rad_s(const MotorModel& motor, const DesignSpec& w) {
  const double bus_V = w.voltage_V.value_or(motor.nominal_voltage_V);
  return test_speeds(motor, bus_V, w.torque_limit_Nm.value_or(usual_torque_limit_Nm(motor, bus_V)))
      .most_lowest_rad_s;
}

base::Problems check_spec(const MotorModel& motor, const DesignSpec& w) {
  base::Problems found;
  const auto add = [&](const char* where, const std::string& value, const char* limit, const char* cure) {
    found.push_back({where, value, limit, cure});
  };
  const auto hold = [&](const char* where, const std::optional<double>& x, const base::Range& own,
                        std::string_view unit, const char* cure) {
    const base::Problems out = x ? base::out_of_range(where, *x, own, unit, cure) : base::Problems{};
    found.insert(found.end(), out.begin(), out.end());
  };
  if (w.mode != Mode::current && w.mode != Mode::speed && w.mode != Mode::position)
    add("mode", "", "must be current, speed or position", "choose the controlled quantity");
  if (w.method == GainMethod::symmetrical_optimum && w.mode == Mode::current)
    add("method", "symmetrical-optimum", "applies to speed loops only",
        "add mode = speed, or use pole-placement or cancellation");
  if (w.delay_periods < 0 || w.delay_periods > 1)
    add("delay_periods", std::to_string(w.delay_periods), "must be 0 or 1",
        "give 0 if a command acts at once, 1 if it acts from the next period on");
  if (w.bandwidth_rad_s && w.method == GainMethod::pole_placement)
    add("bandwidth_rad_s", base::written(*w.bandwidth_rad_s), "is not used by pole placement",
        "give settle_s, or use method = cancellation");
  if (!w.voltage_V && !(motor.nominal_voltage_V > 0.0))
    add("voltage_V", "", "is missing, and the sheet prints no nominal voltage",
        "give the bus voltage in volts");
  using base::above;
  hold("bandwidth_rad_s", w.bandwidth_rad_s, above(0), "rad/s", "give this value in rad/s");
  hold("voltage_V", w.voltage_V, above(0), "V", "give the bus voltage in volts");
  hold("period_s", w.period_s, {0, 1, false, true}, "s", "give the control period in seconds");
  hold("settle_s", w.settle_s, above(0), "s", "give the settling time in seconds");
  hold("current_settle_s", w.current_settle_s, above(0), "s", "give the settling time in seconds");
  hold("damping", w.damping, {0, 1, false, true}, "", "give a damping up to 1; the thesis uses 0.9");
  hold("current_damping", w.current_damping, {0, 1, false, true}, "",
       "give a damping up to 1; the thesis uses 0.9");
  hold("torque_limit_Nm", w.torque_limit_Nm, above(0), "N m", "give this value in N m");
  hold("lowest_speed_rad_s", w.lowest_speed_rad_s, above(0), "rad/s", "give this value in rad/s");
  const double bus_V = w.voltage_V.value_or(motor.nominal_voltage_V);
  if (const double top = bus_V / motor.K_t_Nm_A;
      w.lowest_speed_rad_s && *w.lowest_speed_rad_s >= top && top > 0.0)
    found.push_back({"lowest_speed_rad_s", base::written(*w.lowest_speed_rad_s),
                     "is above the no-load speed of the bus, " + base::three_digits(top) + " rad/s",
                     "lower this value, or give a higher voltage_V"});
  else if (const double most = most_lowest_speed_rad_s(motor, w); w.mode == Mode::speed && w.rotor.lags() &&
                                                                  w.lowest_speed_rad_s && most > 0.0 &&
                                                                  *w.lowest_speed_rad_s > most)
    found.push_back(
        {"lowest_speed_rad_s", base::written(*w.lowest_speed_rad_s),
         "is too high for the test, a step from 1.2 times this speed down to this speed; this bus allows at most " +
             base::three_digits(most) + " rad/s",
         "lower this value, or give a higher voltage_V"});
  if (w.rotor.edges < 0 || w.rotor.edges > 6)
    add("edges", std::to_string(w.rotor.edges), "must lie in 1 to 6",
        "give 1 to 6, or leave this option out for an adaptive number");
  const bool encoder = w.rotor.shaft.kind == ShaftSensorKind::encoder;
  const double capture_Hz = encoder ? w.rotor.shaft.capture_Hz : w.rotor.capture_Hz;
  if (encoder || capture_Hz != 0.0)
    hold("capture_Hz", capture_Hz, base::between(1, 1e9), "Hz", "give the timer's clock in Hz");
  hold("load_inertia_kg_m2", w.load_inertia_kg_m2, base::from(0), "kg m2", "give this value in kg m2");
  return found;
}

}  // namespace sixstep::design

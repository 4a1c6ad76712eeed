// SPDX-License-Identifier: Apache-2.0
#include "sixstep/study/curve/bench.hpp"

#include "sixstep/base/describe.hpp"
#include "sixstep/base/written.hpp"

namespace sixstep::study {

base::Problems check(const Bench& b) {
  base::Problems problems;
  const auto expect = [&](bool holds, const char* where, double value, const char* limit, const char* cure) {
    if (!holds) problems.push_back({where, base::written(value), limit, cure});
  };
  expect(base::above(0).holds(b.voltage_V), "voltage_V", b.voltage_V, "must be above 0",
         "give the bus voltage in volts");
  expect(base::between(-1, 1).holds(b.duty) && b.duty != 0, "duty", b.duty, "must be in (0, 1]",
         "1 is the full voltage; without any the motor only brakes");
  expect(base::above(0).holds(b.pwm_period_s), "pwm_period_s", b.pwm_period_s, "must be above 0",
         "give the PWM period in seconds, as 50e-6 for 20 kHz");
  expect(base::from(0).holds(b.devices.R_on_ohm), "on_resistance_ohm", b.devices.R_on_ohm,
         "must not be negative", "give the switches' resistance in ohms");
  expect(base::from(0).holds(b.devices.V_f_V), "diode_drop_V", b.devices.V_f_V, "must not be negative",
         "give the diodes' forward voltage in volts");
  expect(base::from(0).holds(b.devices.r_d_ohm), "diode_resistance_ohm", b.devices.r_d_ohm,
         "must not be negative", "give the diodes' resistance in ohms");
  return problems;
}

}  // namespace sixstep::study

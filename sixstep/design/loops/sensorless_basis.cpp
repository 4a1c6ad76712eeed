// SPDX-License-Identifier: Apache-2.0
#include "sixstep/design/loops/sensorless_basis.hpp"

#include <algorithm>
#include <cmath>

#include "sixstep/base/written.hpp"

namespace sixstep::design {
namespace {

constexpr double noises = 5.0;           // number of standard deviations that noise does not exceed in a day
constexpr double clear = 4.0;            // ratio of the lowest speed's back-EMF to the threshold
constexpr double forgetting_lags = 5.0;  // exp(-5) of the bus is less than the back-EMF of a slow rotor

/// Problem of filters that are too slow. Samples are in the middle of the on-time: the legs must reach their
/// rails within half of the on-time.
base::Problem too_slow(const SensorlessBasis& b) {
  const double needed_Hz = rail_lags / (base::pi * b.least_on_s());
  return {"terminal_bandwidth_Hz", base::rounded(b.spec.terminal_bandwidth_Hz, 4),
          "lets the terminals reach their rails only after " + base::rounded(2e6 * b.settle_s(), 4) +
              " us (7 time constants), longer than the least on-time of " +
              base::rounded(1e6 * b.least_on_s(), 4) + " us",
          "raise this value to " + base::rounded(needed_Hz, 4) +
              " Hz, or raise lowest_part, the speed of the hand-over"};
}

/// Problem of the comparators' low-pass. Without a low-pass, comparators switch at each edge of the pulse;
/// with a low-pass that is too slow they show an earlier voltage.
base::Problem badly_filtered(const SensorlessBasis& b) {
  const ComparatorSpec& c = b.spec.comparators;
  const std::string least = base::rounded(1.01 / (2.0 * base::pi * b.longest_comparator_lag_s()), 3) +
                            " Hz";  // still sufficient after rounding
  if (!(c.bandwidth_Hz > 0.0))
    return {"comparators.bandwidth_Hz", "",
            "is missing: comparators without a low-pass switch at each PWM edge",
            "set comparators.bandwidth_Hz to " + least};
  return {"comparators.bandwidth_Hz", base::rounded(c.bandwidth_Hz, 4),
          c.against_half_bus
              ? "is too low: the low-pass does not settle within half of the least on-time"
              : "is too low: at no-load speed the low-pass still shows the freewheel at the crossing",
          c.against_half_bus
              ? "raise this value to " + least + ", or raise lowest_part, the speed of the hand-over"
              : "raise this value to " + least};
}

base::Problem hidden_below(const SensorlessBasis& b) {
  const double comparators = b.comparators_V();
  const std::string hides = "hides the back-EMF below " + base::rounded(b.lowest_rad_s, 4) +
                            " rad/s, more than half the no-load speed";
  if (comparators > b.threshold_V)
    return {"comparators", base::rounded(comparators, 4) + " V of error", hides,
            "set a smaller comparators.offset_V and comparators.hysteresis_V"};
  return {"adc_noise_V", base::rounded(b.spec.adc_noise_V, 4), hides,
          "use a converter with more bits or less noise, or dividers with less mismatch"};
}

}  // namespace

double SensorlessBasis::ramp_rad_s2() const {
  return (motor.K_t_Nm_A * start_A - load_Nm) / (2.0 * motor.shaft.J_kg_m2);
}

/// Current that the ramp's acceleration and the sheet's drag need. The rest of start_A is a reserve for a
/// load. A speed loop that began with the whole start_A would overshoot until its integral has decreased.
double SensorlessBasis::ramp_A() const {
  const plant::Shaft& shaft = motor.shaft;
  const double drag_Nm = shaft.coulomb_Nm + shaft.B_Nm_s * lowest_rad_s;
  return std::min(start_A, (shaft.J_kg_m2 * ramp_rad_s2() + drag_Nm) / motor.K_t_Nm_A);
}

double SensorlessBasis::swing_s() const {
  const double stiffness = motor.machine.pole_pairs * motor.K_t_Nm_A * start_A;
  return 2.0 * base::pi * std::sqrt(motor.shaft.J_kg_m2 / stiffness);
}

double SensorlessBasis::comparators_V() const {
  const ComparatorSpec& c = spec.comparators;
  if (!c.followed) return 0.0;
  return (c.against_half_bus ? 2.0 : 3.0) * (c.offset_V + c.hysteresis_V / 2.0);
}

/// Virtual star: half a sector must suffice for the decay of the freewheel's effect. Half the bus: half a
/// pulse must suffice for the low-pass to settle.
double SensorlessBasis::longest_comparator_lag_s() const {
  if (spec.comparators.against_half_bus) return least_on_s() / (2.0 * rail_lags);
  return sector_s(no_load_rad_s) / (2.0 * forgetting_lags);
}

base::Problems unusable(const MotorModel& motor, const SensorlessSpec& spec) {
  base::Problems problems;
  if (!(spec.bus_V > 0.0))
    problems.push_back(
        {"bus_V", base::rounded(spec.bus_V, 4), "must be above 0", "give the voltage of the bus"});
  if (!(spec.period_s > 0.0))
    problems.push_back(
        {"period_s", base::rounded(spec.period_s, 4), "must be above 0", "give the control period"});
  if (!(spec.capture_Hz > 0.0))
    problems.push_back(
        {"capture_Hz", base::rounded(spec.capture_Hz, 4), "must be above 0", "give the timer's frequency"});
  if (spec.adc_bits < 6 || spec.adc_bits > 16)
    problems.push_back(
        {"adc_bits", std::to_string(spec.adc_bits), "must be 6 to 16", "set adc_bits to 6 to 16"});
  if (!(motor.shaft.J_kg_m2 > 0.0) || !(motor.K_t_Nm_A > 0.0) || !(motor.machine.R_ohm > 0.0))
    problems.push_back({"motor", "", "must have resistance, torque constant and inertia",
                        "give resistance_ohm, torque_constant_mNm_A and inertia_gcm2 in the motor file"});
  return problems;
}

SensorlessBasis sensorless_basis(const MotorModel& motor, const SensorlessSpec& spec) {
  SensorlessBasis b{motor, spec};
  b.R_tt = 2.0 * motor.machine.R_ohm;
  b.no_load_rad_s = spec.bus_V / motor.K_t_Nm_A;
  b.nominal_A = nominal_current(motor, spec.bus_V).A;
  b.start_A = std::min(spec.overload * b.nominal_A, 0.8 * spec.bus_V / b.R_tt);
  b.load_Nm = spec.greatest_load * motor.K_t_Nm_A * b.nominal_A +
              std::max(motor.shaft.coulomb_Nm, motor.shaft.static_Nm);
  const double range_V = spec.adc_range_V > 0.0 ? spec.adc_range_V : 1.25 * spec.bus_V;
  b.lsb_V = range_V / static_cast<double>(1 << spec.adc_bits);
  // Noise of 2 u_f - u_s - u_k: its variance is 4 + 1 + 1 times a converter's variance. Rounding adds half a
  // step in each converter.
  b.threshold_V = noises * std::sqrt(6.0) * spec.adc_noise_V + 2.0 * b.lsb_V + spec.mismatch * spec.bus_V;
  b.lock_V = b.threshold_V + b.comparators_V();
  b.lowest_rad_s =
      std::max(spec.lowest_part * b.no_load_rad_s, clear * b.lock_V / (2.0 * motor.machine.K_e_V_s));
  const auto lag_s = [](double Hz) { return Hz > 0.0 ? 1.0 / (2.0 * base::pi * Hz) : 0.0; };
  b.lag_s = lag_s(spec.terminal_bandwidth_Hz);
  if (spec.comparators.followed) b.comparator_lag_s = lag_s(spec.comparators.bandwidth_Hz);
  return b;
}

base::Problems out_of_reach(const SensorlessBasis& b) {
  const SensorlessSpec& spec = b.spec;
  if (!(b.ramp_rad_s2() > 0.0))
    return {
        {"greatest_load", base::rounded(spec.greatest_load, 4),
         "is a larger load than the starting current of " + base::rounded(b.start_A, 4) + " A can accelerate",
         "raise overload, or lower greatest_load"}};
  if (b.lowest_rad_s > 0.5 * b.no_load_rad_s) return {hidden_below(b)};
  if (spec.comparators.followed &&
      !(b.comparator_lag_s > 0.0 && b.comparator_lag_s <= b.longest_comparator_lag_s()))
    return {badly_filtered(b)};
  if (spec.seen == control::NeutralSeen::on_time && 2.0 * b.settle_s() > b.least_on_s()) return {too_slow(b)};
  return {};
}

}  // namespace sixstep::design

// SPDX-License-Identifier: Apache-2.0
#include "sixstep/design/loops/sensorless_observer.hpp"

#include <algorithm>
#include <cmath>

#include "sixstep/base/angle.hpp"
#include "sixstep/base/elementary.hpp"
#include "sixstep/base/written.hpp"

namespace sixstep::design {
namespace {

constexpr double lag_part = 0.2;      // lag as a fraction of a sector at no-load speed
constexpr double level_scale = 0.25;  // level divided by the range of psi's number format
constexpr double observed_periods_a_sector = 4.0;

/// The back-EMF of a phase relative to its peak, `deg` degrees after its zero crossing from below.
double shape(const plant::Machine& machine, double deg) {
  if (machine.back_emf == plant::BackEmf::sine) return base::sin(deg * base::pi / 180.0);
  const double from_top = deg > 270.0 ? deg - 450.0 : deg - 90.0;
  return std::clamp((90.0 - std::fabs(from_top)) / (90.0 - machine.flat_deg / 2.0), -1.0, 1.0);
}

/// shape() minus the part that is common to all three phases.
double own_shape(const plant::Machine& machine, double deg) {
  return (2.0 * shape(machine, deg) - shape(machine, deg + 120.0) - shape(machine, deg + 240.0)) / 3.0;
}

base::Problems problems_of(const MotorModel& motor, const SensorlessSpec& spec) {
  base::Problems problems;
  if (spec.seen != control::NeutralSeen::on_time)
    problems.push_back(
        {"seen", "freewheel", "samples terminals that a diode may clamp, which an observer cannot use",
         "set seen to the on-time, or follow the terminals' zero crossings instead of an observer"});
  if (spec.adc_bits > 14)
    problems.push_back(
        {"adc_bits", std::to_string(spec.adc_bits), "must be at most 14 for an observer",
         "set adc_bits to 14 or less, or follow the terminals' zero crossings instead of an observer"});
  if (!(motor.machine.L_H > 0.0))
    problems.push_back(
        {"motor.L_H", base::rounded(motor.machine.L_H, 4), "must be above 0",
         "give inductance_mH in the motor's file, or follow the terminals' zero crossings instead of an observer"});
  return problems;
}

}  // namespace

double flux_level_V_s(const plant::Machine& machine) {
  constexpr int parts = 60;  // number of intervals of Simpson's rule
  constexpr double step_deg = 30.0 / parts;
  double sum = own_shape(machine, 0.0) + own_shape(machine, 30.0);
  for (int n = 1; n < parts; ++n) sum += (n % 2 == 1 ? 4.0 : 2.0) * own_shape(machine, n * step_deg);
  return machine.K_e_V_s / machine.pole_pairs * sum * step_deg / 3.0 * base::pi / 180.0;
}

base::Result<SensorlessObserver> sensorless_observer(const MotorModel& motor, const SensorlessSpec& spec,
                                                     control::Follow follow) {
  SensorlessObserver out;
  if (!control::observes(follow)) return out;
  if (base::Problems problems = problems_of(motor, spec); !problems.empty()) return problems;
  const plant::Machine& machine = motor.machine;
  const double T = spec.period_s, sector_rad = base::sector_rad / machine.pole_pairs;
  const double sector_s = sector_rad * motor.K_t_Nm_A / spec.bus_V;
  const double m = std::max(0.0, lag_part * sector_s / T - 0.5), p = m / (2.0 + m);
  const double a = base::exp(-machine.R_ohm * T / machine.L_H), b = (1.0 - a) / machine.R_ohm;
  const double range_V = spec.adc_range_V > 0.0 ? spec.adc_range_V : 1.25 * spec.bus_V;
  const double lsb_V = range_V / static_cast<double>(1 << spec.adc_bits);
  const double early = 1.0 - std::clamp(spec.advance_deg, 0.0, 30.0) / 30.0;
  out.pole = p;
  out.level_V_s = flux_level_V_s(machine);
  out.lag_s = (follow == control::Follow::flux ? 0.5 : m + 0.5) * T;
  out.highest_rad_s = sector_rad / (observed_periods_a_sector * T);
  control::ObserverConfig<double>& c = out.chip;
  c.follow = follow;
  c.voltage = {lsb_V / 3.0, static_cast<std::uint16_t>(std::floor(0.03 * spec.bus_V / lsb_V + 0.5)), false};
  c.luenberger = {a, b, 1.0 - p * p / a, (1.0 - p) * (1.0 - p) / b};
  c.sliding_mode = {a, b, a / b, spec.bus_V, 1.0 / a, 1.0 / (1.0 + m)};
  c.flux = {a, 1.0 / b, level_scale * T / out.level_V_s, level_scale * early * early};
  c.counts_per_V = 3.0 / lsb_V;
  c.lag_ticks = static_cast<std::uint32_t>(std::floor(out.lag_s * spec.capture_Hz + 0.5));
  out.steps = {{"a", "exp(-R T/L)", a, ""},
               {"b", "(1 - a)/R", b, "A/V"},
               {"m", "sector at no load/(5 T) - 1/2", m, ""},
               {"lag", "of the estimate", out.lag_s, "s"}};
  if (follow == control::Follow::luenberger) {
    out.steps.push_back({"p", "m/(2 + m), both poles in z", p, ""});
    out.steps.push_back({"l", "1 - p^2/a", c.luenberger.current, ""});
    out.steps.push_back({"h", "(1 - p)^2/b", c.luenberger.emf, "V/A"});
  } else if (follow == control::Follow::sliding_mode) {
    out.steps.push_back({"k", "U", spec.bus_V, "V"});
    out.steps.push_back({"phi", "k b/a", spec.bus_V * b / a, "A"});
    out.steps.push_back({"c", "1/(1 + m)", c.sliding_mode.share, ""});
  } else {
    out.steps.push_back({"psi_c", "K_e/p, shape from 0 to 30 degrees", out.level_V_s, "V s"});
  }
  return out;
}

control::SensorlessDriveConfig<double> sensorless_drive(const control::DriveConfig<double>& drive,
                                                        const SensorlessStart& start,
                                                        const SensorlessObserver& observer) {
  control::SensorlessDriveConfig<double> chip = sensorless_drive(drive, start);
  chip.observer = observer.chip;
  return chip;
}

}  // namespace sixstep::design

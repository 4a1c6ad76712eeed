// SPDX-License-Identifier: Apache-2.0
// Designs a scenario's estimator for a field-oriented drive without a rotor sensor.
#include "sixstep/design/loops/field_estimate.hpp"

#include <cmath>

#include "sixstep/base/angle.hpp"
#include "sixstep/base/written.hpp"
#include "sixstep/study/compile/field_parts.hpp"

namespace sixstep::study {

namespace {

/// A current that drive and motor withstand, A: a cascade's current limit, else the sheet's nominal current,
/// else a tenth of the current that the bus drives through the windings with the rotor at rest.
double current_that_is_safe_A(const Basis& basis, const control::DriveConfig<double>& drive, double R_ohm) {
  constexpr double by_root_3 = 0.57735026918962576;
  if (drive.current_limit_A > 0) return drive.current_limit_A;
  if (basis.motor.nominal_current_A > 0) return basis.motor.nominal_current_A;
  return 0.1 * basis.bus_V * by_root_3 / R_ohm;
}

/// Refuses pulses if the currents at a north pole and at a south pole differ by less than one count of the
/// converters.
base::Problems too_weak(const Scenario& s, const design::FieldMachine& machine, double saturation_A,
                        const control::EstimatorConfig<double>& c) {
  if (s.sensors.currents != rig::CurrentMeasurement::phases || !(c.injection.voltage_V > 0)) return {};
  const double digit_A = 2 * s.sensors.current_range_A.value_or(0.0) / std::ldexp(1.0, s.sensors.adc_bits);
  const double shown_A =
      c.north.current_A / saturation_A * c.injection.voltage_V * s.pwm.period_s / machine.L_d_H;
  if (shown_A >= digit_A) return {};
  return {{"control.field.injection_V", base::rounded(c.injection.voltage_V, 3),
           "distinguishes north from south by " + base::rounded(1e3 * shown_A, 2) +
               " mA, less than one count of the converters, " + base::rounded(1e3 * digit_A, 2) + " mA",
           "raise control.field.injection_V or sensors.adc_bits, or lower sensors.current_range_A"}};
}

}  // namespace

base::Problems add_estimator(const Scenario& s, const Basis& basis, const design::FieldMachine& machine,
                             const control::DriveConfig<double>& drive, double loop_rad_s, FieldAround& out) {
  const Field& wanted = s.control.field;
  if (wanted.angle == FieldAngle::sensors) return {};
  const design::Sheet& sheet = basis.sheet;
  const bool in_middle = s.pwm.sample == SampleAt::middle;
  design::FieldEstimateSpec spec{.injects = wanted.angle != FieldAngle::observer,
                                 .observes = wanted.angle != FieldAngle::injection,
                                 .period_s = s.pwm.period_s,
                                 .delay_periods = waits_periods(s.pwm),
                                 .in_middle = in_middle,
                                 .loop_rad_s = loop_rad_s,
                                 .bus_V = basis.bus_V,
                                 .current_A = current_that_is_safe_A(basis, drive, machine.R_ohm),
                                 .J_kg_m2 = basis.shaft.J_kg_m2,
                                 .bandwidth_rad_s = std::nullopt,
                                 .injection_V = wanted.injection_V,
                                 .high_rad_s = wanted.observer_from_rad_s,
                                 .start_A = wanted.start_current_A};
  if (wanted.angle_bandwidth_Hz) spec.bandwidth_rad_s = 2 * base::pi * *wanted.angle_bandwidth_Hz;
  const double saturation_A = sheet.saturation_current_A ? sheet.saturation_current_A->value : 0.0;
  auto estimate = design::field_estimate(machine, saturation_A, spec);
  if (!estimate) return estimate.problems();
  if (base::Problems problems = too_weak(s, machine, saturation_A, estimate->config); !problems.empty())
    return problems;
  out.estimator = estimate->config;
  out.estimator_steps = std::move(estimate->steps);
  return {};
}

}  // namespace sixstep::study

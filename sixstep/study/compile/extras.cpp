// SPDX-License-Identifier: Apache-2.0
// Adds the optional functions of the drive's loops that a scenario requests (drive_extras.hpp).
#include <algorithm>
#include <cmath>
#include <numbers>

#include "sixstep/study/compile/loops.hpp"

namespace sixstep::study {

namespace {

using control::Mode;

/// The largest current reference, A, if [control.limits] contains no lower bound.
double unlimited_current(const Scenario& s, const control::DriveConfig<double>& drive) {
  return s.control.mode == Mode::current ? std::max(drive.current_limit_A, largest_reference(s))
                                         : drive.current_limit_A;
}

/// Adds limits.hpp. Default gains: with the gain g in A/V and the bus capacitance C, the bus approaches its
/// limit as exp(-g t/C), with a time constant of ten periods, which is slow compared with the sampling. With
/// the gain K in A s/rad, the inertia J and the torque constant K_t, the speed approaches its limit with the
/// time constant J/(K_t K), which is set equal to the current loop's settling time.
void add_limits(const Scenario& s, const Basis& basis, control::DriveConfig<double>& drive) {
  const Limits& wanted = s.control.limits;
  const Regeneration& regeneration = s.control.regeneration;
  if (!wanted.current_A && !wanted.torque_Nm && !wanted.speed_rad_s && !regeneration.limit_V) return;
  const double K_t = basis.motor.K_t_Nm_A, J = basis.shaft.J_kg_m2;
  control::DriveExtras<double>& extras = drive.extras;
  extras.on = extras.limits_current = true;
  control::LimitsConfig<double>& l = extras.limits;
  l.current_A = unlimited_current(s, drive);
  if (wanted.current_A) l.current_A = std::min(l.current_A, *wanted.current_A);
  if (wanted.torque_Nm) l.current_A = std::min(l.current_A, *wanted.torque_Nm / K_t);
  if (wanted.speed_rad_s) {
    l.limits_speed = true;
    l.speed_rad_s = *wanted.speed_rad_s;
    l.A_per_rad_s = wanted.gain_A_s_per_rad.value_or(J / (K_t * current_settling_s(s)));
  }
  if (regeneration.limit_V) {
    l.limits_regeneration = true;
    l.bus_V = *regeneration.limit_V;
    l.A_per_V = regeneration.gain_A_per_V.value_or(s.supply.capacitance_F / (10 * s.pwm.period_s));
  }
  if (drive.current_at_full_torque_A > 0) extras.torque_fraction_per_A = 1 / drive.current_at_full_torque_A;
}

/// Adds smooth_chopping.hpp. The default of its lower threshold is half of the largest ripple, U T/(4 L_tt),
/// with the bus voltage U, the period T and the inductance L_tt between two terminals.
void add_smooth_chopping(const Scenario& s, const Basis& basis, control::DriveExtras<double>& extras) {
  if (!s.control.smooth_chopping.on) return;
  const double half_ripple_A = basis.bus_V * s.pwm.period_s / (8 * 2 * basis.motor.machine.L_H);
  const double below = s.control.smooth_chopping.complementary_below_A.value_or(half_ripple_A);
  extras.on = extras.smooth_chopping = true;
  extras.chopping = {.soft_above_A = s.control.smooth_chopping.soft_above_A.value_or(2 * below),
                     .complementary_below_A = below};
}

/// Widest flat top of the trapezoidal back-EMF. With a wider flat top the flanks are too short for a chip to
/// sample them as ramps.
constexpr double widest_flat_deg = 175.0;

/// Adds commutation_step.hpp.
void add_commutation_step(const Scenario& s, const Basis& basis, control::DriveConfig<double>& drive) {
  control::DriveExtras<double>& extras = drive.extras;
  const CurrentCommutation kind = s.control.current.commutation;
  if (kind == CurrentCommutation::plain) return;
  const plant::Machine& m = basis.motor.machine;
  const design::Sheet& sheet = basis.sheet;
  const double flat_deg =
      sheet.back_emf == design::BackEmfShape::trapezoid ? std::min(sheet.flat_deg, widest_flat_deg) : 120.0;
  const double flank_rad = (180 - flat_deg) * base::pi / 180 / m.pole_pairs;  // in mechanical rad
  extras.on = extras.steps_commutation = true;
  extras.commutation = {.K_t_V_s = basis.motor.K_t_Nm_A,
                        .V_per_A = 1.5 * m.R_ohm,
                        .A_per_V = (0.5 + s.pwm.delay_periods) * s.pwm.period_s / m.L_H,
                        .overlap_bus_V = kind == CurrentCommutation::overlap ? basis.bus_V : 0.0,
                        .missing_V_per_A = 0.75 * drive.current.d1,
                        .flanks_per_rad_s = s.pwm.period_s / flank_rad,
                        .ahead_per_rad_s = s.pwm.delay_periods * s.pwm.period_s / flank_rad,
                        .flat_flanks = (flat_deg - 120) / 2 / (180 - flat_deg)};
}

/// Converts the gains of drive.speed to the positional form. Its derivative part K T_d s/(T_f s + 1) acts on
/// the measured speed; K: gain, T_d: derivative time, T_f: time constant of the filter.
void add_speed_form(const Scenario& s, control::DriveConfig<double>& drive) {
  const SpeedLoop& loop = s.control.speed;
  const bool runs_speed = s.control.mode == Mode::speed || s.control.mode == Mode::position;
  if (loop.law != SpeedLaw::pi || loop.form != SpeedForm::positional || !runs_speed) return;
  control::DriveExtras<double>& extras = drive.extras;
  extras.on = true;
  extras.speed_law = control::SpeedLaw::positional;
  const double K = drive.speed.d1, K_i = drive.speed.d1 + drive.speed.d0;
  const double usual = K > 0 ? std::clamp(K_i / K, 0.0, 1.0) : 1.0;
  const double K_b = loop.anti_windup.value_or(usual);
  extras.speed = {K, K_i, K_b, drive.speed.limit, control::gain_beyond_limit(K, K_i, K_b)};
  extras.speed_weight_off = (1.0 - loop.setpoint_weight.value_or(1.0)) * K;
  if (!loop.derivative_s) return;
  const double T_d = *loop.derivative_s, T_f = loop.derivative_filter_s.value_or(T_d / 10),
               T = s.pwm.period_s;
  extras.speed_derivative = {K * T_d / (T_f + T), T / (T_f + T)};
}

}  // namespace

void add_extras(const Scenario& s, const Basis& basis, control::DriveConfig<double>& drive) {
  control::DriveExtras<double>& extras = drive.extras;
  add_limits(s, basis, drive);
  add_smooth_chopping(s, basis, extras);
  add_commutation_step(s, basis, drive);
  add_speed_form(s, drive);
  if (s.control.slew) {
    extras.on = extras.slews_setpoint = true;
    extras.slew.step = *s.control.slew * s.pwm.period_s;
  }
  extras.staying_phase = s.control.current.feedback == CurrentFeedback::staying_phase;
  extras.on = extras.on || extras.staying_phase;
  if (s.pwm.pattern != control::PwmPattern::upper) {
    extras.on = true;
    extras.pwm = {s.pwm.pattern, 6.0 * basis.motor.machine.pole_pairs * s.pwm.period_s / std::numbers::pi};
  }
  if (s.control.current.back_emf_feed_forward) {
    extras.on = true;
    extras.feed_forward.K_t_V_s = winding_of(s, basis.motor).back_emf_V_s;
  }
  if (s.control.current.measured_bus_from_V) {
    extras.on = true;
    extras.bus.lowest_bus_V = *s.control.current.measured_bus_from_V;
  }
}

}  // namespace sixstep::study

// SPDX-License-Identifier: Apache-2.0
#include "sixstep/design/loops/drive_loops.hpp"

#include <algorithm>
#include <cmath>

#include "sixstep/base/angle.hpp"
#include "sixstep/design/loops/operating_limits.hpp"

namespace sixstep::design {
namespace {

const Polynomial difference{0.0, 1.0};  // z - 1

/// Polynomial of a PI in z - 1: d1 z + d0 = d1 (z - 1) + K_i.
Polynomial of(const PiGains& g) { return {g.d1 + g.d0, g.d1}; }
Polynomial scaled_gains(Polynomial p, double factor) {
  for (double& x : p) x *= factor;
  return p;
}

int whole_periods(const DriveLoops& d) { return static_cast<int>(std::floor(d.late_periods)); }
/// The fractional part of the delay, s.
double late_s_of(const DriveLoops& d) { return (d.late_periods - std::floor(d.late_periods)) * d.period_s; }

/// The motor, sampled with the held voltage u. The transfer functions from u are i/den to the current, w/den
/// to the speed and theta/(den (z - 1)) to the angle. They include the fractional part of the delay, but no
/// whole periods.
struct Plant {
  Polynomial den, i, w, theta;
};

Plant plant_of(const DriveLoops& d) {
  const auto& [R, L, K_e, K_t] = d.winding;
  const double J = d.motor.shaft.J_kg_m2, B = d.motor.shaft.B_Nm_s;
  Linear motor{.states = 2, .A = {}, .B = {}};
  motor.A[0] = {-R / L, -K_e / L, 0.0, 0.0};
  motor.A[1] = {K_t / J, -B / J, 0.0, 0.0};
  motor.A[2] = {0.0, 1.0, 0.0, 0.0};
  motor.B[0] = 1.0 / L;
  const double late = late_s_of(d);
  const Transfer i = sampled(motor, 0, d.period_s, late), w = sampled(motor, 1, d.period_s, late);
  motor.states = 3;
  return {i.den, i.num, w.num, sampled(motor, 2, d.period_s, late).num};
}

/// Polynomials of nested loops; c_i, c_w: controllers of current and speed, K: current at full torque, m:
/// whole periods of delay. The poles of the speed loop closed around the current loop are the roots of (z -
/// 1)^2 den z^m + (z - 1) c_i i + c_w K c_i w.
struct Cascade {
  Polynomial controllers, current_closed, speed_closed;
};

Cascade cascade_of(const DriveLoops& d, const Plant& p) {
  Cascade c;
  c.controllers = scaled_gains(product(of(d.speed), of(d.current)), d.current_at_full_torque_A);
  const Polynomial held = product(p.den, delay(whole_periods(d)).den);
  c.current_closed = sum(product(difference, held), product(of(d.current), p.i));
  c.speed_closed = sum(product(difference, c.current_closed), product(c.controllers, p.w));
  return c;
}

}  // namespace

LoopWinding driven_pair(const MotorModel& motor, control::Chopping chopping) {
  const double s = volts_per_duty(chopping);
  return {2.0 * motor.machine.R_ohm / s, 2.0 * motor.machine.L_H / s, motor.K_t_Nm_A / s, motor.K_t_Nm_A};
}

ZohPlant current_plant(const LoopWinding& winding, double period_s) {
  return current_plant(winding.R_ohm, winding.L_H, period_s);
}

void tell_chopping(control::Chopping chopping, std::vector<DerivationStep>& steps) {
  const double s = volts_per_duty(chopping);
  if (s == 1.0) return;
  const auto a0 = std::find_if(steps.begin(), steps.end(),
                               [](const DerivationStep& step) { return step.symbol == "a0"; });
  steps.insert(
      a0,
      {"s", "hard chopping: a duty moves the mean voltage by s times the bus, R and L count as R/s and L/s",
       s, ""});
}

LoopWinding quadrature_axis(const FieldMachine& machine, bool decoupled) {
  return {machine.R_ohm, machine.L_q_H, decoupled ? 0.0 : machine.magnet_V_s, torque_per_q_A(machine)};
}

Transfer open_current_loop(const DriveLoops& d) {
  const ZohPlant plant = current_plant(d.winding, d.period_s);
  const Transfer pi{of(d.current), difference};
  Transfer held{{plant.b0}, {1.0 + plant.a0, 1.0}};
  if (const double late = late_s_of(d); late > 0.0) {
    held.num.push_back(current_plant(d.winding, d.period_s - late).b0);
    held.den = product(held.den, {1.0, 1.0});
  }
  return series(series(pi, held), delay(whole_periods(d)));
}

Transfer open_current_loop_turning(const DriveLoops& d) {
  const Plant p = plant_of(d);
  return {product(of(d.current), p.i), product(difference, product(p.den, delay(whole_periods(d)).den))};
}

Transfer open_speed_loop(const DriveLoops& d) {
  const Plant p = plant_of(d);
  const Cascade c = cascade_of(d, p);
  return {product(c.controllers, p.w), product(difference, c.current_closed)};
}

Transfer speed_loop_by_setpoint(const DriveLoops& d, const LinearLaw& law) {
  const Plant p = plant_of(d);
  const Polynomial acts = product(scaled_gains(of(d.current), d.current_at_full_torque_A), p.w);
  const Polynomial apart = sum(law.y, scaled_gains(law.r, -1.0));
  return {product(acts, law.r), sum(product(cascade_of(d, p).current_closed, law.q), product(acts, apart))};
}

Transfer open_speed_loop(const DriveLoops& d, const LinearLaw& law) {
  const Plant p = plant_of(d);
  const Polynomial acts = product(scaled_gains(of(d.current), d.current_at_full_torque_A), p.w);
  return {product(acts, law.y), product(cascade_of(d, p).current_closed, law.q)};
}

Transfer open_position_loop(const DriveLoops& d) {
  const Plant p = plant_of(d);
  const Cascade c = cascade_of(d, p);
  const double gain = d.position_gain_rad_s_per_deg * 180.0 / base::pi;
  return {scaled_gains(product(c.controllers, p.theta), gain), product(difference, c.speed_closed)};
}

}  // namespace sixstep::design

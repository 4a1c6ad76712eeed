// SPDX-License-Identifier: Apache-2.0
// The general plant's numbers as its recurrence wants them, its memory beside what both kernels have (plant/state.hpp), its
// mode, and the series of one segment.
#pragma once
#include "sixstep/plant/expansion.hpp"
#include "sixstep/plant/general/shape.hpp"

namespace sixstep::plant::general {

inline constexpr std::size_t most_rotations = 12;

template <class Real>
struct Constants {
  // Star equivalent: phases of R and L; the delta's loop has its own.
  PerLeg<Real> R{};
  Real L = 0, inv_L = 0, L_D = 0;  ///< L_S of the salient machine, (L_d - L_q)/2
  bool salient = false, has_loop = false;
  Real loop_R = 0, loop_inv_L = 0;
  ShapeTable<Real> shape;
  std::size_t rotations = 0, salient_rotation = 0;
  Real pole_pairs = 1;
  // Shaft; elastic: the motor's side alone.
  Real inv_J = 0, B = 0, coulomb = 0, breakaway = 0, inv_gear = 1;
  bool elastic = false, dry_friction = false, locked = false;
  Real load_inv_J = 0, load_B = 0, stiffness = 0, damping = 0;
  Real load = 0, fan = 0, gravity = 0, gravity_angle = 0;
  // Bridge.
  general::Devices devices;
  PoleTable<Real> poles;

  // Supply.
  Real V_0 = 0, R_b = 0, inv_R_b = 0, inv_L_b = 0, inv_C = 0;
  bool source_sinks = true;
  Real brake_conductance = 0, brake_on = 0, brake_off = 0;
  // What rounding is.
  Real volt_scale = 0, amp_scale = 0, speed_scale = 0, torque_scale = 0;
  Real volt_noise = 0, amp_noise = 0, speed_noise = 0, torque_noise = 0;
  Real steady_rate = 0, turning_rate = 0;  ///< 1/s, and 1/s per mechanical rad/s
};

/// Beside plant::State: the delta's loop, the source's current, the load's side.
template <class Real>
struct More {
  Real loop = 0, loop_low = 0;      ///< j_ab + j_bc + j_ca, A
  Real source = 0, source_low = 0;  ///< through L_b, A
  Real load_w = 0, load_w_low = 0;  ///< elastic: rad/s
  Real twist = 0, twist_low = 0;    ///< elastic: theta_m/n - theta_load, rad
};

/// plant::Mode's members, and what only this kernel decides.
struct Mode {
  Legs legs{};
  Motion motion = Motion::free;
  bool source_feeds = true;
  std::uint8_t sector = 0, piece = 0;
  bool braking = false;       ///< the brake resistor is on
  std::int8_t load_sign = 1;  ///< of the load's speed, for what grows with w|w|
  bool operator==(const Mode&) const = default;
};

/// Terms of one segment, beside those that both kernels have.
template <class Real>
struct Series {
  using Coefficients = series::Coefficients<Real>;
  PerLeg<Coefficients>
      pole;  ///< u_k against the negative rail; fewer than two legs connected: e_k for those that float
  PerLeg<Coefficients> emf;
  Coefficients loop, source, load_w, twist;
  Coefficients load, cogging;       ///< torques: the load's at its side, the cogging one at the motor's
  Coefficients shaft;               ///< torque that holds against the breakaway one, at rest
  Coefficients turn_cos, turn_sin;  ///< of the load's angle, for gravity
  std::array<Coefficients, most_rotations> cos, sin;
};

}  // namespace sixstep::plant::general

// SPDX-License-Identifier: Apache-2.0
// Data of the general plant:
// - constants in the form that the recurrence uses,
// - state in addition to plant/state.hpp,
// - mode,
// - series of one segment.
#pragma once
#include "sixstep/plant/expansion.hpp"
#include "sixstep/plant/general/shape.hpp"

namespace sixstep::plant::general {

inline constexpr std::size_t most_rotations = 12;

/// A piece of a load torque over the load's speed w, linear between two points of the table: now + rise w, N
/// m.
template <class Real>
struct TorquePiece {
  Real from = 0, to = 0;  ///< rad/s of the load
  Real now = 0, rise = 0;
};

/// A piece of the open-circuit voltage over the charge q, linear between two points of the table: now + rise
/// q, V.
template <class Real>
struct ChargePiece {
  Real from = 0, to = 0;
  Real now = 0, rise = 0;
};

/// Parameters of the fluxes along the magnet's axis and across it, V s: lambda_d = L_d i_d (1 - i_d/(2
/// I_sat)), lambda_q = L_q i_q.
template <class Real>
struct Axes {
  Real L_d = 0, L_q = 0, inv_I_sat = 0;
  std::size_t rotation = 0;  ///< index of the rotation of order 1
};

template <class Real>
struct Constants {
  // Winding: R and L of a phase of the equivalent star. The current around a delta has the parameters
  // `loop_R` and `loop_inv_L`.
  PerLeg<Real> R{};
  Real L = 0, inv_L = 0;
  bool has_axes = false, has_loop = false;
  Axes<Real> axes;
  Real loop_R = 0, loop_inv_L = 0;
  ShapeTable<Real> shape;
  std::size_t rotations = 0;
  Real pole_pairs = 1;
  // Shaft. With a rigid shaft, inv_J and B include the load's side. With an elastic shaft, they are the
  // motor's values only.
  Real inv_J = 0, B = 0, coulomb = 0, breakaway = 0, gear = 1, inv_gear = 1;
  Real J_1 = 0, B_1 = 0, efficiency = 1;
  bool elastic = false, dry_friction = false, locked = false, imposed = false;
  Real load_J = 0, load_inv_J = 0, load_B = 0, stiffness = 0, damping = 0;
  Real load_rate = 0, speed_rate = 0;  ///< change of the load's torque per s, N m/s, and of an imposed speed,
                                       ///< rad/s^2
  Real fan = 0, gravity = 0, gravity_angle = 0;
  std::vector<TorquePiece<Real>> over_speed;
  // Bridge.
  general::Devices devices;
  PerLeg<PoleTable<Real>> poles;  ///< one table per leg, because the resistance of a channel depends on its
                                  ///< temperature

  const PoleTerms<Real>& terms(std::size_t leg, Connection at) const {
    return poles[leg][static_cast<std::size_t>(at)];
  }

  // Supply.
  Source source = Source::steady;
  Real V_0 = 0, R_b = 0, inv_R_b = 0, inv_L_b = 0, inv_C = 0, R_C = 0;
  bool source_sinks = true;
  Real sink = 0;  ///< largest current that the source absorbs, A, if source_sinks is false
  Real brake_conductance = 0, brake_on = 0, brake_off = 0;
  std::vector<ChargePiece<Real>> open_circuit;
  Real inv_capacity = 0, inv_R_1 = 0, inv_C_1 = 0;
  Real mains_peak = 0, mains_drop = 0, mains_rate = 0,
       mains_edge = 0;  ///< mains_rate: angular frequency, rad/s; mains_edge: phase of a pulse's end, rad
  // Scales and noise levels of rounding.
  Real volt_scale = 0, amp_scale = 0, speed_scale = 0, torque_scale = 0;
  Real per_amp = 0, per_speed = 0;  ///< 1/amp_scale, 1/speed_scale
  Real volt_noise = 0, amp_noise = 0, speed_noise = 0, torque_noise = 0;
  Real steady_rate = 0, turning_rate = 0;  ///< 1/s, and 1/s per mechanical rad/s

  bool lossy_gear() const { return efficiency < 1; }
  bool speed_is_given() const { return imposed && !elastic; }
};

/// State in addition to plant::State: current around a delta, source, load's side. `bus` of plant::State is
/// U_s.
template <class Real>
struct More {
  using Kept = series::CompensatedSum<Real>;
  Kept loop;       ///< j_ab + j_bc + j_ca, A
  Kept source;     ///< current through L_b, A
  Kept load_w;     ///< speed of the load with an elastic shaft, rad/s
  Kept twist;      ///< twist of an elastic shaft, theta_m/n - theta_load, rad; n: gear ratio
  Kept load;       ///< present load torque from constant, steps and ramps, N m
  Kept capacitor;  ///< voltage of the capacitor, V, if it has a series resistance
  Kept charge;     ///< charge of a battery, relative to the whole charge
  Kept slow;       ///< voltage of a battery's RC element, V
  Kept phase;      ///< phase of the mains relative to the top of the present pulse, rad
};

template <class Real, class Visit>
void for_each_kept(const More<Real>& m, Visit&& visit) {
  for (const typename More<Real>::Kept* kept :
       {&m.loop, &m.source, &m.load_w, &m.twist, &m.load, &m.capacitor, &m.charge, &m.slow, &m.phase})
    visit(*kept);
}

/// The members of plant::Mode, and members that only this kernel needs.
struct Mode {
  Legs legs{};
  Motion motion = Motion::free;
  bool source_feeds = true;  ///< false: the source absorbs its largest current
  std::uint8_t sector = 0;
  std::uint16_t piece = 0;       ///< 16 bits, because a table of the back-EMF may have many pieces
  bool braking = false;          ///< true: the brake resistor is on
  std::int8_t load_sign = 1;     ///< sign of the load's speed, for the torque k w|w|
  std::int8_t through_sign = 1;  ///< sign of the torque that a lossy gear transmits
  std::uint8_t load_piece = 0, charge_piece = 0;
  bool operator==(const Mode&) const = default;
};

/// Series of one segment in addition to those of plant::Expansion.
template <class Real>
struct Series {
  using Coefficients = series::Coefficients<Real>;
  PerLeg<Coefficients>
      pole;  ///< u_k against the negative rail; if fewer than two legs are connected: e_k for floating legs
  PerLeg<Coefficients> emf;
  Coefficients loop, source, load_w, twist;
  Coefficients load, cogging;       ///< torque of the load at the load's side, cogging torque at the motor
  Coefficients through;             ///< torque that a lossy gear transmits, at the load's side
  Coefficients forward, backward;   ///< torque at rest that must exceed the breakaway torque to start the
                                    ///< motor, forward and backward
  Coefficients turn_cos, turn_sin;  ///< cos and sin of the load's angle, for gravity
  Coefficients open;                ///< open-circuit voltage V_0 of the source
  Coefficients capacitor, capacitor_A, charge, slow, phase, mains_cos, mains_sin;
  Coefficients d, q;  ///< currents along and across the magnet's axis, if has_axes is true
  std::array<Coefficients, most_rotations> cos, sin;
};

}  // namespace sixstep::plant::general

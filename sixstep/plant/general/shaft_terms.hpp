// SPDX-License-Identifier: Apache-2.0
// Terms of the shaft (model.md 7): the load's torque at the load's side, the torque through gear and
// coupling, and the motion of both sides. If the load's speed is imposed, the load's torque follows from the
// balance of torques.
#pragma once
#include "sixstep/plant/general/constants.hpp"
#include "sixstep/plant/torques.hpp"

namespace sixstep::plant::general {

/// Torque at the motor's side of a gear, divided by its value without losses. It is above 1 if the motor
/// drives, and below 1 if the load drives.
template <class Real>
constexpr Real gear_factor(Real efficiency, bool motor_drives) {
  return motor_drives ? 1 / efficiency : efficiency;
}

template <class Real>
class ShaftTerms {
 public:
  using Coefficients = series::Coefficients<Real>;

  ShaftTerms(const Constants<Real>& c, Mode& mode, Real load, Expansion<Real>& y, Series<Real>& z)
      : c_(c), mode_(mode), load_(load), y_(y), z_(z), plain_(is_plain(c)), turns_(turns(mode.motion)) {}

  /// Computes terms n of the torques and n + 1 of speeds and angles; y.torque[n] and z.cogging[n] must be
  /// set.
  [[gnu::always_inline]] void take_order(int n, Real f) {
    if (!plain_) return take_any_order(n, f);
    const Real w = y_.w[n], load = steps(n);
    z_.load_w[n] = c_.inv_gear * w;
    z_.load[n] = load;
    const Real pushes = y_.torque[n] + z_.cogging[n] - c_.inv_gear * load;
    z_.forward[n] = z_.backward[n] = pushes;
    Real sum = pushes - c_.B * w;
    if (n == 0) sum -= against(mode_.motion, c_.coulomb);
    y_.w[n + 1] = turns_ ? f * c_.inv_J * sum : Real(0);
    y_.x[n + 1] = f * c_.pole_pairs * w;
  }

 private:
  /// True for a rigid shaft with a lossless gear whose load has only steps and ramps.
  static bool is_plain(const Constants<Real>& c) {
    return !c.elastic && !c.imposed && !c.lossy_gear() && c.fan == 0 && c.gravity == 0 &&
           c.over_speed.empty();
  }
  /// Term n of the part of the load torque that is set by steps and ramps.
  Real steps(int n) const { return n == 0 ? load_ : n == 1 ? c_.load_rate * y_.h : Real(0); }

  [[gnu::noinline]] void take_any_order(int n, Real f) {
    if (!c_.elastic) z_.load_w[n] = c_.inv_gear * y_.w[n];
    z_.load[n] = asked_for(n, f);
    const Real drive = y_.torque[n] + z_.cogging[n];
    const Real dry = n == 0 ? against(mode_.motion, c_.coulomb) : Real(0);
    if (c_.elastic)
      move_both(n, f, drive, dry);
    else if (c_.imposed)
      follow(n, f, drive, dry);
    else if (c_.lossy_gear())
      move_through_losses(n, f, drive, dry);
    else
      move(n, f, drive, dry);
    y_.x[n + 1] = f * c_.pole_pairs * y_.w[n];
  }

  static Real product(const Coefficients& a, const Coefficients& b, int n) {
    Real sum = a[0] * b[n];
    for (int j = 1; j <= n; ++j) sum += a[j] * b[n - j];
    return sum;
  }

  /// Term n of the load torque: steps and ramps, fan, weight, and torque over speed.
  Real asked_for(int n, Real f) {
    Real load = steps(n);
    if (c_.fan != 0) load += Real(mode_.load_sign) * c_.fan * product(z_.load_w, z_.load_w, n);
    if (c_.gravity != 0) {
      load += c_.gravity * z_.turn_sin[n];
      z_.turn_sin[n + 1] = f * product(z_.load_w, z_.turn_cos, n);
      z_.turn_cos[n + 1] = -f * product(z_.load_w, z_.turn_sin, n);
    }
    if (!c_.over_speed.empty()) {
      const TorquePiece<Real>& piece = c_.over_speed[mode_.load_piece];
      load += (n == 0 ? piece.now : Real(0)) + piece.rise * z_.load_w[n];
    }
    return load;
  }
  /// Sets the torques at rest that must exceed the breakaway torque, for forward and backward motion.
  /// `through`: torque through the gear at the load's side, without the gear's losses.
  void push(int n, Real drive, Real through) {
    z_.forward[n] = drive - c_.inv_gear * through;
    z_.backward[n] = z_.forward[n];
    if (!c_.lossy_gear()) return;
    // For forward motion a positive `through` means that the motor drives the load, a negative one that the
    // load drives the motor. For backward motion the two cases are exchanged.
    const bool asks = z_.through[0] > 0;
    z_.forward[n] = drive - c_.inv_gear * through * gear_factor(c_.efficiency, asks);
    z_.backward[n] = drive - c_.inv_gear * through * gear_factor(c_.efficiency, !asks);
  }
  void turn(int n, Real f, Real inv_J, Real sum) { y_.w[n + 1] = turns_ ? f * inv_J * sum : Real(0); }

  void move(int n, Real f, Real drive, Real dry) {
    push(n, drive, z_.load[n]);
    Real sum = z_.forward[n] - c_.B * y_.w[n];
    if (n == 0) sum -= dry;
    turn(n, f, c_.inv_J, sum);
  }

  /// Rigid shaft: the gear transmits J_2 dw_2/dt + B_2 w_2 + T_load, with inertia J_2, friction B_2 and speed
  /// w_2 of the load's side. The losses of the gear do not change the sign of this torque.
  void move_through_losses(int n, Real f, Real drive, Real dry) {
    const Real at_load = c_.load_B * z_.load_w[n] + z_.load[n];
    const Real at_motor = drive - dry - c_.B_1 * y_.w[n];
    const Real own = c_.load_J * c_.inv_gear;
    const bool moves = turns(mode_.motion);
    const bool forward = mode_.motion == Motion::forward;
    if (n == 0) {
      z_.through[0] = moves ? handed_on(at_load + own / c_.J_1 * at_motor, own, forward) : at_load;
      judge_through();
    }
    push(n, drive, at_load);
    const Real k = gear_factor(c_.efficiency, (mode_.through_sign > 0) == forward);
    turn(n, f, 1 / (c_.J_1 + k * own * c_.inv_gear), at_motor - k * c_.inv_gear * at_load);
    z_.through[n] = f > 0 ? own * y_.w[n + 1] / f + at_load : at_load;
  }
  /// Torque through the gear, J_2 dw_2/dt + B_2 w_2 + T_load, computed from the sum `sign_of`, which has the
  /// same sign. If J_2 is most of the inertia, the torque is a small part of this sum and may be at its noise
  /// level.
  Real handed_on(Real sign_of, Real own, bool forward) const {
    const Real k = gear_factor(c_.efficiency, (sign_of > 0) == forward);
    return sign_of / (1 + k * own * c_.inv_gear / c_.J_1);
  }
  /// A torque above noise level determines the sign. Otherwise the sign from the last event is kept.
  void judge_through() {
    if (plant::detail::abs(z_.through[0]) > c_.torque_noise * c_.gear)
      mode_.through_sign = z_.through[0] > 0 ? 1 : -1;
  }

  void move_both(int n, Real f, Real drive, Real dry) {
    const Real slip = c_.inv_gear * y_.w[n] - z_.load_w[n];
    const Real shaft = c_.stiffness * z_.twist[n] + c_.damping * slip;
    Real felt = shaft;
    z_.through[n] = shaft;
    if (c_.lossy_gear()) {
      if (n == 0) judge_through();
      felt *= gear_factor(c_.efficiency, (mode_.through_sign > 0) == (mode_.motion == Motion::forward));
    }
    push(n, drive, shaft);
    turn(n, f, c_.inv_J, drive - c_.inv_gear * felt - dry - c_.B * y_.w[n]);
    z_.twist[n + 1] = f * slip;
    if (c_.imposed) {
      z_.load_w[n + 1] = n == 0 ? f * c_.speed_rate : Real(0);
      z_.load[n] = shaft - c_.load_B * z_.load_w[n] - (n == 0 ? c_.load_J * c_.speed_rate : Real(0));
    } else {
      z_.load_w[n + 1] = f * c_.load_inv_J * (shaft - c_.load_B * z_.load_w[n] - z_.load[n]);
    }
  }

  /// Rigid shaft with imposed speed: the load's torque is the part of the motor's torque that friction and
  /// acceleration do not need.
  void follow(int n, Real f, Real drive, Real dry) {
    const Real rate = n == 0 && turns(mode_.motion) ? c_.speed_rate * c_.gear : Real(0);
    y_.w[n + 1] = f * rate;
    z_.forward[n] = z_.backward[n] = 0;
    z_.load[n] = c_.gear * (drive - dry - c_.B * y_.w[n] - rate / c_.inv_J);
  }

  const Constants<Real>& c_;
  Mode& mode_;
  Real load_;
  Expansion<Real>& y_;
  Series<Real>& z_;
  bool plain_, turns_;
};

}  // namespace sixstep::plant::general

// SPDX-License-Identifier: Apache-2.0
// Computes one order of the general plant's Taylor recurrence (model.md 7 to 9): first voltages, then
// currents, torques, shaft and supply. The loops are not unrolled, because this kernel is used only where the
// lean kernel does not suffice.
#pragma once
#include "sixstep/plant/general/axes_terms.hpp"
#include "sixstep/plant/general/shaft_terms.hpp"
#include "sixstep/plant/general/supply_terms.hpp"

namespace sixstep::plant::general {

template <class Real>
class Recurrence {
 public:
  using Coefficients = series::Coefficients<Real>;

  Recurrence(const Constants<Real>& c, const Mode& mode, Expansion<Real>& y, Series<Real>& z)
      : c_(c),
        y_(y),
        z_(z),
        axes_(c, y, z),
        supply_(c, mode, y, z),
        rotations_(c.rotations),
        is_linear_(c.shape.is_linear),
        has_axes_(c.has_axes),
        has_loop_(c.has_loop) {
    const Piece<Real>& piece = c.shape.sector[mode.sector][mode.piece];
    for (int k = 0; k < way_count; ++k) {
      rise_[k] = piece.rise[k];
      now_[k] = piece.now[k] + rise_[k] * y.x[0];
    }
    ramp_carries_ = has_loop_;
    int last = 2;
    for (unsigned k = 0; k < 3; ++k) {
      if (is_floating(mode.legs[k])) {
        leg_[last--] = static_cast<int>(k);
        continue;
      }
      terms_[connected_] = c.terms(k, mode.legs[k]);
      R_[connected_] = c.R[k];
      ramp_carries_ |= rise_[k] != 0;
      leg_[connected_++] = static_cast<int>(k);
    }
    part_ = connected_ > 0 ? 1 / Real(connected_) : Real(0);
    change_ = connected_ >= 2 ? c.inv_L : Real(0);
    if (has_axes_) axes_.begin();
  }

  /// Computes terms n + 1 of all states from terms n, and terms n of the quantities that follow from the
  /// states. The shaft is a separate object. No reference therefore points to the members of this class, and
  /// the compiler can keep them in registers.
  template <class Shaft>
  [[gnu::always_inline]] void take_order(int n, Shaft& shaft) {
    const Real f = y_.h / Real(n + 1);
    turn(n, f);
    supply_.begin_order(n);
    electrical(n, f);
    torques(n);
    shaft.take_order(n, f);
    supply_.end_order(n, f);
  }

 private:
  static Real product(const Coefficients& a, const Coefficients& b, int n) {
    Real sum = a[0] * b[n];
    for (int j = 1; j <= n; ++j) sum += a[j] * b[n - j];
    return sum;
  }
  /// Term n of (a - a[0]) b.
  static Real later_product(const Coefficients& a, const Coefficients& b, int n) {
    Real sum = 0;
    for (int j = 1; j <= n; ++j) sum += a[j] * b[n - j];
    return sum;
  }

  /// Computes the next order of cos(m theta) and sin(m theta), for the order m of each rotation. The products
  /// of these series with the speed are the parts of the back-EMF.
  [[gnu::always_inline]] void turn(int n, Real f) {
    if (is_linear_) wx_ = later_product(y_.x, y_.w, n);
    for (std::size_t r = 0; r < rotations_; ++r) {
      const Real rate = f * c_.pole_pairs * Real(c_.shape.rotations[r].order);
      w_cos_[r] = product(y_.w, z_.cos[r], n);
      w_sin_[r] = product(y_.w, z_.sin[r], n);
      z_.cos[r][n + 1] = -rate * w_sin_[r];
      z_.sin[r][n + 1] = rate * w_cos_[r];
    }
  }
  Real emf(int way, int n) const {
    Real e = now_[way] * y_.w[n];
    if (is_linear_) e += rise_[way] * wx_;
    for (std::size_t r = 0; r < rotations_; ++r)
      e += c_.shape.rotations[r].cos[way] * w_cos_[r] + c_.shape.rotations[r].sin[way] * w_sin_[r];
    return e;
  }

  /// In nearly all segments two or three legs are connected. For these cases the number is a compile-time
  /// constant.
  [[gnu::always_inline]] void electrical(int n, Real f) {
    if (connected_ == 3) return electrical_with(std::integral_constant<int, 3>(), n, f);
    if (connected_ == 2) return electrical_with(std::integral_constant<int, 2>(), n, f);
    electrical_with(connected_, n, f);
  }
  template <class Count>
  [[gnu::always_inline]] void electrical_with(Count connected, int n, Real f) {
    PerLeg<Real> drive;  // u_k - R_k i_k - e_k of the connected legs, in the order of leg_
    Real mean = 0;
    for (int j = 0; j < connected; ++j) {
      const int k = leg_[j];
      const PoleTerms<Real>& terms = terms_[j];
      const Real e = emf(k, n), i = y_.i[k][n];
      Real u = terms.bus_share * y_.bus[n] - terms.r_ohm * i;
      if (n == 0) u += terms.offset_V;
      z_.emf[k][n] = e;
      z_.pole[k][n] = u;
      drive[j] = u - R_[j] * i - e;
      mean += drive[j];
    }
    mean *= part_;
    if (has_axes_) {
      for (int k = 0; k < 3; ++k) y_.i[k][n + 1] = 0;
      mean += axes_.take_order(n, f, drive, connected, leg_);
    } else {
      const Real rate = f * change_;
      for (int j = 0; j < connected; ++j) y_.i[leg_[j]][n + 1] = rate * (drive[j] - mean);
    }
    for (int j = connected; j < 3; ++j) {
      const int k = leg_[j];
      const Real e = emf(k, n);
      z_.emf[k][n] = e;
      z_.pole[k][n] = mean + e;
      y_.i[k][n + 1] = 0;
    }
    if (has_loop_) z_.loop[n + 1] = -f * c_.loop_inv_L * (c_.loop_R * z_.loop[n] + emf(3, n));
  }

  /// Sums the torque T_e of phases, of the current around a delta and of the magnet's axes. The cogging
  /// torque is separate, because it needs no current.
  [[gnu::always_inline]] void torques(int n) {
    const auto current = [&](int way) { return way < 3 ? y_.i[way][n] : z_.loop[n] * Real(1.0L / 3); };
    const int used = has_loop_ ? way_count : 3;
    Real torque = 0, cogging = 0;
    for (int k = 0; k < used; ++k) torque += now_[k] * current(k);
    if (ramp_carries_) {
      Real along = 0;
      for (int k = 0; k < used; ++k) along += rise_[k] * current(k);
      along_[n] = along;
      torque += later_product(y_.x, along_, n);
    }
    for (std::size_t r = 0; r < rotations_; ++r) {
      const Rotation<Real>& part = c_.shape.rotations[r];
      Real by_cos = 0, by_sin = 0;
      for (int k = 0; k < used; ++k) {
        by_cos += part.cos[k] * current(k);
        by_sin += part.sin[k] * current(k);
      }
      by_cos_[r][n] = by_cos;
      by_sin_[r][n] = by_sin;
      torque += product(z_.cos[r], by_cos_[r], n) + product(z_.sin[r], by_sin_[r], n);
      cogging += part.cogging_cos * z_.cos[r][n] + part.cogging_sin * z_.sin[r][n];
    }
    if (has_axes_) torque += c_.pole_pairs * axes_.torque(n);
    y_.torque[n] = torque;
    z_.cogging[n] = cogging;
  }

  const Constants<Real>& c_;
  Expansion<Real>& y_;
  Series<Real>& z_;
  AxesTerms<Real> axes_;
  SupplyTerms<Real> supply_;
  std::size_t rotations_;
  bool is_linear_, has_axes_, has_loop_;
  bool ramp_carries_ = false;  ///< true: the back-EMF of a connected leg is on a ramp, or the winding is a
                               ///< delta
  int connected_ = 0;
  std::array<int, 3> leg_{};       ///< the connected legs, then the floating legs
  PerLeg<PoleTerms<Real>> terms_;  ///< terms of the connected legs, in the order of leg_
  PerLeg<Real> R_;                 ///< resistances in the order of leg_
  Real part_ = 0, change_ = 0;     ///< 1/(number of connected legs); 1/L if a current can flow, else 0
  PerWay<Real> now_{}, rise_{};
  Real wx_ = 0;
  std::array<Real, most_rotations> w_cos_, w_sin_;
  std::array<Coefficients, most_rotations> by_cos_, by_sin_;
  Coefficients along_;
};

}  // namespace sixstep::plant::general

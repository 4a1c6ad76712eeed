// SPDX-License-Identifier: Apache-2.0
// One order of the general plant's Taylor recurrence (model.md 7 to 9): voltages from currents, currents from flux linkages,
// torques from both, then shaft and supply. Loops are counted, not unrolled: this kernel is for what the lean one lacks.
#pragma once
#include "sixstep/plant/general/constants.hpp"
#include "sixstep/plant/torques.hpp"

namespace sixstep::plant::general {

template <class Real>
class Recurrence {
 public:
  using Coefficients = series::Coefficients<Real>;

  Recurrence(const Constants<Real>& c, const Mode& mode, Expansion<Real>& y, Series<Real>& z)
      : c_(c), mode_(mode), piece_(c.shape.sector[mode.sector][mode.piece]), y_(y), z_(z) {
    for (int k = 0; k < 3; ++k) {
      if (is_floating(mode.legs[k])) continue;
      leg_[connected_++] = k;
      share_[k] = c.poles[static_cast<std::size_t>(mode.legs[k])].bus_share;
    }
    for (int k = 0, n = connected_; k < 3; ++k)
      if (is_floating(mode.legs[k])) leg_[n++] = k;
    for (int k = 0; k < way_count; ++k) now_[k] = piece_.now[k] + piece_.rise[k] * y.x[0];
    if (c.salient) begin_salient();
  }
  int connected() const { return connected_; }

  /// Terms n + 1 of all states from terms n, and terms n of what follows from them.
  void take_order(int n) {
    const Real f = y_.h / Real(n + 1);
    turn(n, f);
    electrical(n, f);
    torques(n);
    move(n, f);
    supply(n, f);
  }

 private:
  static Real product(const Coefficients& a, const Coefficients& b, int n) {
    Real sum = a[0] * b[n];
    for (int j = 1; j <= n; ++j) sum += a[j] * b[n - j];
    return sum;
  }
  /// (a - a[0]) b
  static Real later_product(const Coefficients& a, const Coefficients& b, int n) {
    Real sum = 0;
    for (int j = 1; j <= n; ++j) sum += a[j] * b[n - j];
    return sum;
  }

  /// The rotations turn with the speed; their products with it are the back-EMF's parts.
  void turn(int n, Real f) {
    if (c_.shape.is_linear) wx_ = later_product(y_.x, y_.w, n);
    for (std::size_t r = 0; r < c_.rotations; ++r) {
      const Real rate = f * c_.pole_pairs * Real(c_.shape.rotations[r].order);
      w_cos_[r] = product(y_.w, z_.cos[r], n);
      w_sin_[r] = product(y_.w, z_.sin[r], n);
      z_.cos[r][n + 1] = -rate * w_sin_[r];
      z_.sin[r][n + 1] = rate * w_cos_[r];
    }
  }
  Real emf(int way, int n) const {
    Real e = now_[way] * y_.w[n];
    if (c_.shape.is_linear) e += piece_.rise[way] * wx_;
    for (std::size_t r = 0; r < c_.rotations; ++r)
      e += c_.shape.rotations[r].cos[way] * w_cos_[r] + c_.shape.rotations[r].sin[way] * w_sin_[r];
    return e;
  }

  void electrical(int n, Real f) {
    PerLeg<Real> drive{}, e{};  // u_k, u_k - R_k i_k - e_k
    Real mean = 0;
    for (int k = 0; k < 3; ++k) {
      z_.emf[k][n] = e[k] = emf(k, n);
      if (is_floating(mode_.legs[k])) continue;
      const PoleTerms<Real>& terms = c_.poles[static_cast<std::size_t>(mode_.legs[k])];
      Real u = terms.bus_share * y_.bus[n] - terms.r_ohm * y_.i[k][n];
      if (n == 0) u += terms.offset_V;
      z_.pole[k][n] = u;
      drive[k] = u - c_.R[k] * y_.i[k][n] - e[k];
      mean += drive[k];
    }
    mean = connected_ > 0 ? mean / Real(connected_) : Real(0);
    for (int k = 0; k < 3; ++k) y_.i[k][n + 1] = 0;
    Real mutual = 0;
    if (c_.salient)
      mutual = salient_currents(n, f, drive);
    else if (connected_ >= 2)
      for (int m = 0; m < connected_; ++m) y_.i[leg_[m]][n + 1] = f * c_.inv_L * (drive[leg_[m]] - mean);
    for (int m = connected_; m < 3; ++m) z_.pole[leg_[m]][n] = mean + mutual + e[leg_[m]];
    if (c_.has_loop) z_.loop[n + 1] = -f * c_.loop_inv_L * (c_.loop_R * z_.loop[n] + emf(3, n));
  }

  // Saliency in the stator's two axes: lambda = (L_S + L_D [cos sin; sin -cos](2 theta_d)) i, without the magnet's part.
  void begin_salient() {
    turned_cos_[0] = salient_cos(0);
    turned_sin_[0] = salient_sin(0);
    set_axes(0);
    lambda_(0, c_.L * alpha_[0] + c_.L_D * (turned_cos_[0] * alpha_[0] + turned_sin_[0] * beta_[0]),
            c_.L * beta_[0] + c_.L_D * (turned_sin_[0] * alpha_[0] - turned_cos_[0] * beta_[0]));
  }
  void lambda_(int n, Real alpha, Real beta) {
    flux_alpha_[n] = alpha;
    flux_beta_[n] = beta;
  }
  void set_axes(int n) {
    alpha_[n] = (2 * y_.i[0][n] - y_.i[1][n] - y_.i[2][n]) * Real(1.0L / 3);
    beta_[n] = (y_.i[1][n] - y_.i[2][n]) * inv_root3;
  }
  // 2 theta_d = 2 theta_e - 300 deg
  Real salient_cos(int n) const {
    return Real(0.5) * z_.cos[c_.salient_rotation][n] - half_root3 * z_.sin[c_.salient_rotation][n];
  }
  Real salient_sin(int n) const {
    return Real(0.5) * z_.sin[c_.salient_rotation][n] + half_root3 * z_.cos[c_.salient_rotation][n];
  }
  /// Returns what the flux's change adds to the pole voltage of a floating leg: 3/2 of its own.
  Real salient_currents(int n, Real f, const PerLeg<Real>& drive) {
    turned_cos_[n + 1] = salient_cos(n + 1);
    turned_sin_[n + 1] = salient_sin(n + 1);
    // What the turning alone does to the flux, currents held at this order: terms with all but the newest current.
    Real by_alpha = 0, by_beta = 0;
    for (int j = 1; j <= n + 1; ++j) {
      by_alpha += turned_cos_[j] * alpha_[n + 1 - j] + turned_sin_[j] * beta_[n + 1 - j];
      by_beta += turned_sin_[j] * alpha_[n + 1 - j] - turned_cos_[j] * beta_[n + 1 - j];
    }
    by_alpha *= c_.L_D;
    by_beta *= c_.L_D;
    const Real aa = c_.L + c_.L_D * turned_cos_[0], bb = c_.L - c_.L_D * turned_cos_[0],
               ab = c_.L_D * turned_sin_[0];
    if (connected_ == 3) {
      const Real va = f * (2 * drive[0] - drive[1] - drive[2]) * Real(1.0L / 3) - by_alpha;
      const Real vb = f * (drive[1] - drive[2]) * inv_root3 - by_beta;
      const Real inverse = 1 / (aa * bb - ab * ab);
      const Real alpha = (bb * va - ab * vb) * inverse, beta = (aa * vb - ab * va) * inverse;
      y_.i[0][n + 1] = alpha;
      y_.i[1][n + 1] = -alpha / 2 + half_root3 * beta;
      y_.i[2][n + 1] = -alpha / 2 - half_root3 * beta;
    } else if (connected_ == 2) {
      // Along the pair: lambda_j - lambda_k = g . lambda, and a current i from j to k is (2/3) g i.
      const int j = leg_[0], k = leg_[1];
      const Real g_alpha = axis_alpha[j] - axis_alpha[k], g_beta = axis_beta[j] - axis_beta[k];
      const Real L =
          Real(2.0L / 3) * (g_alpha * (aa * g_alpha + ab * g_beta) + g_beta * (ab * g_alpha + bb * g_beta));
      const Real i = (f * (drive[j] - drive[k]) - (g_alpha * by_alpha + g_beta * by_beta)) / L;
      y_.i[j][n + 1] = i;
      y_.i[k][n + 1] = -i;
    }
    set_axes(n + 1);
    lambda_(n + 1, aa * alpha_[n + 1] + ab * beta_[n + 1] + by_alpha,
            ab * alpha_[n + 1] + bb * beta_[n + 1] + by_beta);
    if (connected_ != 2 || f == 0) return 0;
    const int r = leg_[2];
    return Real(1.5) * (axis_alpha[r] * flux_alpha_[n + 1] + axis_beta[r] * flux_beta_[n + 1]) / f;
  }

  /// T_e of all ways and of the saliency, and beside it the cogging torque, which needs no current.
  void torques(int n) {
    const auto current = [&](int way) { return way < 3 ? y_.i[way][n] : z_.loop[n] * Real(1.0L / 3); };
    const int used = c_.has_loop ? way_count : 3;
    Real torque = 0, cogging = 0;
    Real along = 0;
    for (int k = 0; k < used; ++k) {
      along += piece_.rise[k] * current(k);
      torque += now_[k] * current(k);
    }
    if (c_.shape.is_linear) {
      along_[n] = along;
      torque += later_product(y_.x, along_, n);
    }
    for (std::size_t r = 0; r < c_.rotations; ++r) {
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
    if (c_.salient)
      torque += Real(1.5) * c_.pole_pairs * (product(flux_alpha_, beta_, n) - product(flux_beta_, alpha_, n));
    y_.torque[n] = torque;
    z_.cogging[n] = cogging;
  }

  void move(int n, Real f) {
    const Real load_w = c_.elastic ? z_.load_w[n] : c_.inv_gear * y_.w[n];
    if (!c_.elastic) z_.load_w[n] = load_w;
    Real load = n == 0 ? c_.load : Real(0);
    if (c_.fan != 0) load += Real(mode_.load_sign) * c_.fan * product(z_.load_w, z_.load_w, n);
    if (c_.gravity != 0) {
      load += c_.gravity * z_.turn_sin[n];
      z_.turn_sin[n + 1] = f * product(z_.load_w, z_.turn_cos, n);
      z_.turn_cos[n + 1] = -f * product(z_.load_w, z_.turn_sin, n);
    }
    z_.load[n] = load;
    Real against_rotor = load;
    if (c_.elastic) {
      const Real shaft = c_.stiffness * z_.twist[n] + c_.damping * (c_.inv_gear * y_.w[n] - load_w);
      z_.load_w[n + 1] = f * c_.load_inv_J * (shaft - c_.load_B * load_w - load);
      z_.twist[n + 1] = f * (c_.inv_gear * y_.w[n] - load_w);
      against_rotor = shaft;
    }
    z_.shaft[n] = y_.torque[n] + z_.cogging[n] - c_.inv_gear * against_rotor;
    Real sum = z_.shaft[n] - c_.B * y_.w[n];
    if (n == 0) sum -= against(mode_.motion, c_.coulomb);
    y_.w[n + 1] = turns(mode_.motion) ? f * c_.inv_J * sum : Real(0);
    y_.x[n + 1] = f * c_.pole_pairs * y_.w[n];
  }

  void supply(int n, Real f) {
    if (c_.inv_C == 0) {
      y_.bus[n + 1] = 0;
      return;
    }
    Real into = 0;
    for (int m = 0; m < connected_; ++m) into -= share_[leg_[m]] * y_.i[leg_[m]][n];
    if (mode_.braking) into -= c_.brake_conductance * y_.bus[n];
    const Real above = (n == 0 ? c_.V_0 : Real(0)) - y_.bus[n];
    if (c_.inv_L_b > 0) {
      z_.source[n + 1] = mode_.source_feeds ? f * c_.inv_L_b * (above - c_.R_b * z_.source[n]) : Real(0);
    } else {
      z_.source[n] = mode_.source_feeds ? c_.inv_R_b * above : Real(0);
    }
    y_.bus[n + 1] = f * c_.inv_C * (into + z_.source[n]);
  }

  static constexpr Real half_root3 = Real(0.86602540378443864676372317075293618L);
  static constexpr Real inv_root3 = Real(0.57735026918962576450914878050195746L);
  static constexpr PerLeg<Real> axis_alpha{1, Real(-0.5), Real(-0.5)}, axis_beta{0, half_root3, -half_root3};

  const Constants<Real>& c_;
  const Mode& mode_;
  const Piece<Real>& piece_;
  Expansion<Real>& y_;
  Series<Real>& z_;
  int connected_ = 0;
  std::array<int, 3> leg_{};
  PerLeg<Real> share_{};
  PerWay<Real> now_{};
  Real wx_ = 0;
  std::array<Real, most_rotations> w_cos_, w_sin_;
  std::array<Coefficients, most_rotations> by_cos_, by_sin_;
  Coefficients along_, alpha_, beta_, flux_alpha_, flux_beta_, turned_cos_, turned_sin_;
};

}  // namespace sixstep::plant::general

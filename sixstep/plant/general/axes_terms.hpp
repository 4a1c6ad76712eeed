// SPDX-License-Identifier: Apache-2.0
// Currents and torque of a machine with saliency or saturation. The flux along the magnet's axis is lambda_d
// = L_d i_d (1 - i_d/(2 I_sat)), the flux across it lambda_q = L_q i_q (model.md 7). The equations are solved
// in the stator's two axes. The newest coefficients of the currents appear in the fluxes linearly, multiplied
// by the incremental inductances. Each order is therefore a linear equation for these coefficients.
#pragma once
#include "sixstep/plant/general/constants.hpp"

namespace sixstep::plant::general {

inline constexpr long double half_root3_l = 0.86602540378443864676372317075293618L;
inline constexpr long double inv_root3_l = 0.57735026918962576450914878050195746L;

template <class Real>
class AxesTerms {
 public:
  using Coefficients = series::Coefficients<Real>;

  AxesTerms(const Constants<Real>& c, Expansion<Real>& y, Series<Real>& z) : c_(c), y_(y), z_(z) {}

  void begin() {
    turn(0);
    set_currents(0);
    z_.d[0] = cos_[0] * alpha_[0] + sin_[0] * beta_[0];
    z_.q[0] = cos_[0] * beta_[0] - sin_[0] * alpha_[0];
    flux_d_[0] = c_.axes.L_d * z_.d[0] * (1 - z_.d[0] * c_.axes.inv_I_sat / 2);
    flux_q_[0] = c_.axes.L_q * z_.q[0];
    // Incremental inductances along d and along q, transformed to the stator's axes.
    const Real along = c_.axes.L_d * (1 - z_.d[0] * c_.axes.inv_I_sat), across = c_.axes.L_q;
    aa_ = cos_[0] * cos_[0] * along + sin_[0] * sin_[0] * across;
    bb_ = sin_[0] * sin_[0] * along + cos_[0] * cos_[0] * across;
    ab_ = cos_[0] * sin_[0] * (along - across);
    along_ = along;
  }

  /// Computes the currents of order n + 1 from `drive`, which is u_k - R_k i_k - e_k of order n in the order
  /// of `leg`; f = h/(n + 1). The first `connected` entries of `leg` are the connected legs. Returns the
  /// voltage that the change of the flux adds to the pole voltage of a floating leg: 3/2 of the voltage
  /// induced in this leg.
  Real take_order(int n, Real f, const PerLeg<Real>& drive, int connected, const std::array<int, 3>& leg) {
    turn(n + 1);
    const Changes without = without_newest(n + 1);
    if (connected == 3) {
      const Real va = f * (2 * drive[0] - drive[1] - drive[2]) * Real(1.0L / 3) - without.alpha;
      const Real vb = f * (drive[1] - drive[2]) * Real(inv_root3_l) - without.beta;
      const Real inverse = 1 / (aa_ * bb_ - ab_ * ab_);
      const Real alpha = (bb_ * va - ab_ * vb) * inverse, beta = (aa_ * vb - ab_ * va) * inverse;
      y_.i[0][n + 1] = alpha;
      y_.i[1][n + 1] = -alpha / 2 + Real(half_root3_l) * beta;
      y_.i[2][n + 1] = -alpha / 2 - Real(half_root3_l) * beta;
    } else if (connected == 2) {
      // Flux linkage of the pair: lambda_j - lambda_k = g . lambda, with the difference g of the axes of j
      // and k. A current i from j to k is the vector (2/3) g i.
      const int j = leg[0], k = leg[1];
      const Real g_alpha = axis_alpha[j] - axis_alpha[k], g_beta = axis_beta[j] - axis_beta[k];
      const Real L = Real(2.0L / 3) *
                     (g_alpha * (aa_ * g_alpha + ab_ * g_beta) + g_beta * (ab_ * g_alpha + bb_ * g_beta));
      const Real i = (f * (drive[0] - drive[1]) - (g_alpha * without.alpha + g_beta * without.beta)) / L;
      y_.i[j][n + 1] = i;
      y_.i[k][n + 1] = -i;
    }
    const Real alpha = aa_ * alpha_of(n + 1) + ab_ * beta_of(n + 1) + without.alpha;
    const Real beta = ab_ * alpha_of(n + 1) + bb_ * beta_of(n + 1) + without.beta;
    note(n + 1, without);
    if (connected != 2 || f == 0) return 0;
    return Real(1.5) * (axis_alpha[leg[2]] * alpha + axis_beta[leg[2]] * beta) / f;
  }

  /// Order n of the torque per pole pair: (3/2)(lambda_d i_q - lambda_q i_d).
  Real torque(int n) const {
    Real sum = 0;
    for (int j = 0; j <= n; ++j) sum += flux_d_[j] * z_.q[n - j] - flux_q_[j] * z_.d[n - j];
    return Real(1.5) * sum;
  }

 private:
  static constexpr PerLeg<Real> axis_alpha{1, Real(-0.5), Real(-0.5)},
      axis_beta{0, Real(half_root3_l), -Real(half_root3_l)};
  struct Changes {
    Real d = 0, q = 0, flux_d = 0, flux_q = 0, alpha = 0, beta = 0;
  };

  /// cos and sin of theta_d = theta_e - 150 deg, the angle of the magnet's axis.
  void turn(int n) {
    const Real cos = z_.cos[c_.axes.rotation][n], sin = z_.sin[c_.axes.rotation][n];
    cos_[n] = sin / 2 - Real(half_root3_l) * cos;
    sin_[n] = -cos / 2 - Real(half_root3_l) * sin;
  }
  Real alpha_of(int n) const { return (2 * y_.i[0][n] - y_.i[1][n] - y_.i[2][n]) * Real(1.0L / 3); }
  Real beta_of(int n) const { return (y_.i[1][n] - y_.i[2][n]) * Real(inv_root3_l); }
  void set_currents(int n) {
    alpha_[n] = alpha_of(n);
    beta_[n] = beta_of(n);
  }

  /// The coefficients of order n of the fluxes, without the part that the currents of order n cause.
  Changes without_newest(int n) const {
    Changes to;
    for (int j = 1; j <= n; ++j) {
      to.d += cos_[j] * alpha_[n - j] + sin_[j] * beta_[n - j];
      to.q += cos_[j] * beta_[n - j] - sin_[j] * alpha_[n - j];
    }
    Real square = 0;
    if (c_.axes.inv_I_sat > 0)
      for (int j = 1; j < n; ++j) square += z_.d[j] * z_.d[n - j];
    to.flux_d = along_ * to.d - c_.axes.L_d * c_.axes.inv_I_sat / 2 * square;
    to.flux_q = c_.axes.L_q * to.q;
    to.alpha = cos_[0] * to.flux_d - sin_[0] * to.flux_q;
    to.beta = sin_[0] * to.flux_d + cos_[0] * to.flux_q;
    for (int j = 1; j <= n; ++j) {
      to.alpha += cos_[j] * flux_d_[n - j] - sin_[j] * flux_q_[n - j];
      to.beta += sin_[j] * flux_d_[n - j] + cos_[j] * flux_q_[n - j];
    }
    return to;
  }
  void note(int n, const Changes& without) {
    set_currents(n);
    const Real d = cos_[0] * alpha_[n] + sin_[0] * beta_[n], q = cos_[0] * beta_[n] - sin_[0] * alpha_[n];
    z_.d[n] = without.d + d;
    z_.q[n] = without.q + q;
    flux_d_[n] = without.flux_d + along_ * d;
    flux_q_[n] = without.flux_q + c_.axes.L_q * q;
  }

  const Constants<Real>& c_;
  Expansion<Real>& y_;
  Series<Real>& z_;
  Coefficients cos_, sin_, alpha_, beta_, flux_d_, flux_q_;  ///< cos_ and sin_ are cosine and sine of theta_d
  Real aa_ = 0, bb_ = 0, ab_ = 0, along_ = 0;
};

}  // namespace sixstep::plant::general

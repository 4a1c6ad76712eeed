// SPDX-License-Identifier: Apache-2.0
// Computes the temperatures of two bodies that exchange heat, winding and housing (model.md 8, (11)). The
// solution of the linear system with its two eigenvalues is exact. The eigenvalues may have any sign.
#pragma once
#include <cmath>

#include "sixstep/base/elementary.hpp"

namespace sixstep::plant {

/// Lower bound of the factor by which temperature changes K_e. The factor is linear in the temperature, which
/// is not valid for a magnet that has lost nine tenths of its field.
inline constexpr double least_on_K_e = 0.1;

/// Temperatures w, h of winding and housing above the ambient, K: w' = ww w + wh h + b_w, h' = hw w + hh h +
/// b_h, with wh and hw positive.
struct TwoBodies {
  double ww = 0.0, wh = 0.0, hw = 0.0, hh = 0.0;  ///< 1/s
  double b_w = 0.0, b_h = 0.0;                    ///< K/s

  double determinant() const { return ww * hh - wh * hw; }
};

struct BodyTemperatures {
  double winding = 0.0, housing = 0.0;
};

namespace detail {

/// (exp(x) - 1)/x. For |x| < 2^-7 it is computed by its series, whose last term x^6/7! is then below 2^-53.
inline double grown(double x) {
  if (std::fabs(x) >= 0x1p-7) return (base::exp(x) - 1) / x;
  return 1 + x / 2 * (1 + x / 3 * (1 + x / 4 * (1 + x / 5 * (1 + x / 6 * (1 + x / 7)))));
}

}  // namespace detail

/// Temperatures after t_s: x(t) = x_0 + (integral of exp(A s) over 0..t) (A x_0 + b). A is the matrix of ww,
/// wh, hw, hh, and lambda an eigenvalue. The initial slope A x_0 + b is split into the eigenvectors (wh,
/// lambda - ww). Each part is multiplied by (exp(lambda t) - 1)/lambda.
inline BodyTemperatures after(const TwoBodies& n, const BodyTemperatures& start, double t_s) {
  const double w = start.winding, v = start.housing;
  const double slope_w = n.ww * w + n.wh * v + n.b_w, slope_h = n.hw * w + n.hh * v + n.b_h;
  const double half = (n.ww - n.hh) / 2, root = std::sqrt(half * half + n.wh * n.hw);
  const double mean = (n.ww + n.hh) / 2;
  // lambda - ww = -half +- root. The value without cancellation is computed first. The second value follows
  // from the product of both, -wh hw.
  const double steep = half > 0 ? -half - root : -half + root, other = -n.wh * n.hw / steep;
  const double up = half > 0 ? other : steep, down = half > 0 ? steep : other;
  const double part_up = (slope_h - slope_w / n.wh * down) / (up - down);
  const double part_down = slope_w / n.wh - part_up;
  const double grown_up = t_s * detail::grown((mean + root) * t_s),
               grown_down = t_s * detail::grown((mean - root) * t_s);
  return {w + n.wh * (part_up * grown_up + part_down * grown_down),
          v + up * part_up * grown_up + down * part_down * grown_down};
}

}  // namespace sixstep::plant

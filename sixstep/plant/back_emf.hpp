// SPDX-License-Identifier: Apache-2.0
// Tables of the back-EMF's shape: f_k = alpha_k phi0 + beta_k phi1 in each piece of a sector. x is the angle
// since the sector's start, electrical rad. The products of speed with phi0 and phi1 are the same for all
// three phases. alpha_k and beta_k are constants of phase k in a piece.
//   trapezoid of any flat width: (phi0, phi1) = (1, x), up to three pieces per sector
//   sine:                        (phi0, phi1) = (cos x, sin x), one piece
#pragma once
#include <array>

#include "sixstep/base/angle.hpp"
#include "sixstep/plant/circuit.hpp"
#include "sixstep/plant/machine.hpp"

namespace sixstep::plant {

template <class Real>
struct EmfPiece {
  Real from = 0, to = 0;  ///< x within the sector
  PerLeg<Real> alpha{}, beta{};
  PerLeg<Real> alpha_above{}, beta_above{};  ///< alpha and beta minus the mean of the other two legs' values
};

/// Multiplies a shape of peak 1 by K_e (V s, or N m/A), so that alpha phi0 + beta phi1 is the back-EMF per
/// speed.
template <class Real>
constexpr void scale(EmfPiece<Real>& piece, Real K_e) {
  for (int k = 0; k < 3; ++k) piece.alpha[k] *= K_e, piece.beta[k] *= K_e;
  for (int k = 0; k < 3; ++k) {
    const int j = (k + 1) % 3, m = (k + 2) % 3;
    piece.alpha_above[k] = piece.alpha[k] - (piece.alpha[j] + piece.alpha[m]) / 2;
    // mutant: piece.beta[k] - (piece.beta[j] + piece.beta[m]) / 2 => piece.beta[k]
    piece.beta_above[k] = piece.beta[k] - (piece.beta[j] + piece.beta[m]) / 2;
  }
}

/// The pieces of one sector in order of x; entries from `count` on are unused.
template <class Real>
struct EmfSector {
  std::array<EmfPiece<Real>, 3> piece{};
  int count = 1;
};

template <class Real>
using EmfTable = std::array<EmfSector<Real>, 6>;

namespace detail {

/// Angle from the centre of phase k's flat top to the start of sector s, degrees in (-180, 180]: 60 s - 60 -
/// 120 k.
constexpr int centre_distance_deg(int sector, int k) {
  int d = (60 * sector - 60 - 120 * k) % 360;
  if (d <= -180) d += 360;
  if (d > 180) d -= 360;
  return d;
}

/// alpha and beta of a trapezoid f in one piece (model.md 1). f is 1 on the top, -1 on the bottom, and (90 -
/// |phi|)/(90 - w/2) on the ramps. phi is the angle from the centre of the top, w the flat width, both in
/// degrees. The middle of the piece is `middle_deg` after the sector's start.
template <class Real>
constexpr void trapezoid_line(int start_deg, Real middle_deg, Real flat_deg, Real& alpha, Real& beta) {
  Real phi = Real(start_deg) + middle_deg;
  Real start = Real(start_deg);
  if (phi > Real(180)) {
    phi -= Real(360);
    start -= Real(360);
  }
  const Real side = phi < 0 ? Real(-1) : Real(1);
  const Real distance = side * phi, half = flat_deg / 2;
  // mutant: Real(180) - half => Real(180)
  if (distance <= half || distance >= Real(180) - half) {
    alpha = distance <= half ? Real(1) : Real(-1);
    beta = 0;
    return;
  }
  const Real ramp = Real(90) - half;
  alpha = (Real(90) - side * start) / ramp;
  beta = -side * (Real(180) / Real(3.14159265358979323846264338327950288L)) / ramp;
}

}  // namespace detail

template <class Real>
constexpr EmfTable<Real> trapezoid_table(double flat_deg) {
  const Real flat = Real(flat_deg);
  Real kink = flat / 2;  // every kink lies at +-w/2 modulo 60 degrees
  while (kink >= Real(60)) kink -= Real(60);
  const Real mirrored = Real(60) - kink;
  const Real low = kink < mirrored ? kink : mirrored, high = kink < mirrored ? mirrored : kink;
  std::array<Real, 4> bound{0, low, high, 60};
  EmfTable<Real> table{};
  for (int s = 0; s < 6; ++s) {
    int count = 0;
    for (int b = 0; b < 3; ++b) {
      if (!(bound[b + 1] > bound[b])) continue;
      EmfPiece<Real>& piece = table[s].piece[count++];
      const auto rad = [](Real deg) {
        return deg == Real(60) ? Real(base::sector_rad) : deg / 60 * Real(base::sector_rad);
      };
      piece.from = rad(bound[b]);
      piece.to = rad(bound[b + 1]);
      for (int k = 0; k < 3; ++k)
        // mutant: (bound[b] + bound[b + 1]) / 2 => bound[b]
        detail::trapezoid_line(detail::centre_distance_deg(s, k), (bound[b] + bound[b + 1]) / 2, flat,
                               piece.alpha[k], piece.beta[k]);
    }
    table[s].count = count;
  }
  return table;
}

/// cos(theta - 60 deg - 120 deg k) = cos(d) cos(x) - sin(d) sin(x) with d a multiple of 60 degrees.
template <class Real>
constexpr EmfTable<Real> sine_table() {
  constexpr Real half_root3 = Real(0.86602540378443864676372317075293618L);
  EmfTable<Real> table{};
  for (int s = 0; s < 6; ++s) {
    EmfPiece<Real>& piece = table[s].piece[0];
    piece.to = Real(base::sector_rad);
    for (int k = 0; k < 3; ++k) {
      const int d = detail::centre_distance_deg(s, k);
      const int size = d < 0 ? -d : d;
      piece.alpha[k] = size == 0 ? Real(1) : size == 60 ? Real(0.5) : size == 120 ? Real(-0.5) : Real(-1);
      piece.beta[k] = size == 0 || size == 180 ? Real(0) : d > 0 ? -half_root3 : half_root3;
    }
  }
  return table;
}

}  // namespace sixstep::plant

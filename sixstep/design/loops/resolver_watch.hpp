// SPDX-License-Identifier: Apache-2.0
// Computes when a resolver counts as lost. The check uses c^2 + s^2, which does not depend on the angle if
// the windings are ideal.
//
//   intact     c = k_1 cos phi,  s = k_2 sin(phi + q):  c^2 + s^2 lies within the eigenvalues l_1 <= l_2 of
//              [k_1^2 + k_2^2 sin^2 q,  k_2^2 sin q cos q;  k_2^2 sin q cos q,  k_2^2 cos^2 q]
//   too low    below l_1/2. If one of two equal windings is left, the angle is then wrong by more than 45
//              degrees, beyond which a detector cannot determine the direction. If both signals are weak,
//              the excitation is then below 0.71 of full excitation
//   too high   above 5/4 l_2: a converter whose range is a quarter larger still measures that value in one winding
//   how often  a limit is a distance z s from the intact range, s the rms noise of each signal. Noise alone
//              takes sqrt(c^2 + s^2) beyond the limit less often than exp(-z^2/2)/2. Consecutive results
//              share a sample, so that every second one is independent. The number in a row is such that
//              noise alone causes a loss less than once in 10^12 results.
//
// All values are relative to the amplitude that the drive expects. At rest a broken winding is not found if
// its signal is small at the present angle. It is found when the shaft has turned by at most 45 degrees of
// the resolver's own turn.
#pragma once

namespace sixstep::design {

struct ResolverShows {
  double k_1 = 1.0, k_2 = 1.0;  ///< amplitudes of cosine and sine winding, as the drive sees them
  double quadrature_rad = 0.0;  ///< q, as far as the drive does not correct it
  double noise = 0.0;           ///< s, rms noise of each signal
};

struct ResolverLimits {
  double least_square = 0.0, greatest_square = 0.0;
  int in_a_row = 1;  ///< number of consecutive results outside the limits, at most 255
};
ResolverLimits resolver_limits(const ResolverShows& whole);

}  // namespace sixstep::design

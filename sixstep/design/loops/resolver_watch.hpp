// SPDX-License-Identifier: Apache-2.0
// Computes when a resolver counts as lost. The check uses c^2 + s^2 of the two signals, which does not depend
// on the angle phi if the windings are ideal.
//
//   intact     c = k_1 cos phi,  s = k_2 sin(phi + q):  c^2 + s^2 lies within the eigenvalues l_1 <= l_2 of
//              [k_1^2 + k_2^2 sin^2 q,  k_2^2 sin q cos q;  k_2^2 sin q cos q,  k_2^2 cos^2 q]
//   too low    below l_1/2. If only one of two equal windings works, c^2 + s^2 falls below this limit where
//              the angle is wrong by more than 45 degrees; beyond this error a detector cannot determine the
//              direction. If both signals are weak, the limit is reached at 0.71 of full excitation.
//   too high   above 5/4 l_2: a converter whose range is a quarter larger still measures this value in one
//              winding
//   how often  a limit is at a distance z n from the intact range, with the rms noise n of each signal. Noise
//              moves sqrt(c^2 + s^2) beyond the limit with a probability below exp(-z^2/2)/2. Consecutive
//              results share a sample; every second result is independent. The number in a row is chosen so
//              that noise causes a loss less than once in 10^12 results.
//
// All values are relative to the amplitude that the drive expects. At rest a broken winding is not detected
// if its signal is small at the present angle. It is detected when the shaft has turned by at most 45 degrees
// of the resolver's own turn.
#pragma once

namespace sixstep::design {

struct ResolverShows {
  double k_1 = 1.0, k_2 = 1.0;  ///< amplitudes of cosine and sine winding after the drive's correction
  double quadrature_rad = 0.0;  ///< q, the part that the drive does not correct
  double noise = 0.0;           ///< n, rms noise of each signal
};

struct ResolverLimits {
  double least_square = 0.0, greatest_square = 0.0;
  int in_a_row = 1;  ///< number of consecutive results outside the limits, at most 255
};
ResolverLimits resolver_limits(const ResolverShows& whole);

}  // namespace sixstep::design

// SPDX-License-Identifier: Apache-2.0
// When a resolver is lost: of its windings only c^2 + s^2 is known not to hang on the angle.
//
//   whole      c = k_1 cos phi,  s = k_2 sin(phi + q):  c^2 + s^2 lies within the eigenvalues l_1 <= l_2 of
//              [k_1^2 + k_2^2 sin^2 q,  k_2^2 sin q cos q;  k_2^2 sin q cos q,  k_2^2 cos^2 q]
//   too low    below l_1/2: of like windings that are left one at a time the angle is then off by more than 45 degrees, which
//              is as far as a detector tells a way at all, and full excitation by more than three parts in ten
//   too high   above 5/4 l_2: a converter whose range has a quarter of room still shows that of one winding
//   how often  noise of s in each signal takes sqrt(c^2 + s^2) beyond either limit, z s away, less often than
//              exp(-z^2/2)/2; neighbours share a sample, every second result is new. So many in a row that it comes less than
//              once in 10^12 results.
//
// All as parts of the amplitude that the drive expects. What a resolver shows at rest at one angle does not tell a broken
// winding whose share there is small: it is told when the shaft has turned by 45 degrees of the resolver's own turn at most.
#pragma once

namespace sixstep::design {

struct ResolverShows {
  double k_1 = 1.0, k_2 = 1.0;  ///< amplitudes that the drive makes of cosine and sine
  double quadrature_rad = 0.0;  ///< q that it does not take off
  double noise = 0.0;           ///< s, root mean square of each signal
};

struct ResolverLimits {
  double least_square = 0.0, greatest_square = 0.0;
  int in_a_row = 1;  ///< results outside, at most 255
};
ResolverLimits resolver_limits(const ResolverShows& whole);

}  // namespace sixstep::design

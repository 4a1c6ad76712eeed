// SPDX-License-Identifier: Apache-2.0
// A Window is the stretch of time that a figure looks at.
#pragma once
#include <cmath>
#include <limits>

namespace sixstep::study {

struct Window {
  double from_s = 0.0;
  double to_s = std::numeric_limits<double>::infinity();
};

/// What of [0, s] of a segment lies inside: fractions of its length h, which begins at t0. Empty where from
/// is not below to.
struct Clip {
  double from, to;
  bool empty() const { return !(from < to); }
};
inline Clip clipped(const Window& window, double t0, double h, double s) {
  return {window.from_s > t0 ? (window.from_s - t0) / h : 0.0,
          window.to_s - t0 < h ? std::fmin(s, (window.to_s - t0) / h) : s};
}

}  // namespace sixstep::study

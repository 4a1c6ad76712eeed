// SPDX-License-Identifier: Apache-2.0
// The time interval over which a figure is measured.
#pragma once
#include <cmath>
#include <limits>

namespace sixstep::study {

struct Window {
  double from_s = 0.0;
  double to_s = std::numeric_limits<double>::infinity();
};

/// The part of [0, s] of a segment that lies inside the window, as fractions of the segment's length h from
/// t0. Empty if `from` is not below `to`.
struct Clip {
  double from, to;
  bool empty() const { return !(from < to); }
};
inline Clip clipped(const Window& window, double t0, double h, double s) {
  return {window.from_s > t0 ? (window.from_s - t0) / h : 0.0,
          window.to_s - t0 < h ? std::fmin(s, (window.to_s - t0) / h) : s};
}

}  // namespace sixstep::study

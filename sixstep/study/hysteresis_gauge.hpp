// SPDX-License-Identifier: Apache-2.0
// How well an event hysteresis keeps its band: excess above the upper limit, shortfall below the lower one
// outside of the recovery from a commutation or a new reference, and the switching frequency.
#pragma once
#include <algorithm>
#include <cmath>
#include <limits>

#include "sixstep/study/gauge.hpp"
#include "sixstep/study/signals.hpp"

namespace sixstep::study {

/// NaN, which meets no requirement, where no comparator was ever armed.
struct HysteresisFigures {
  double excess_A = std::numeric_limits<double>::quiet_NaN(), deficit_A = excess_A;
};

class HysteresisGauge {
 public:
  /// One segment, up to its fraction s, by every armed comparator.
  template <class Rig>
  void segment(const Rig& rig, double s) {
    for (int which = 0; which < 2; ++which) {
      const rig::ArmedComparator armed = rig.modulator().comparator(which);
      if (!armed.armed) continue;
      if (std::isnan(figures_.excess_A)) figures_ = {0.0, 0.0};
      const auto& y = rig.plant().expansion();
      const plant::PerLeg<double> w = rig.modulator().comparator_weights(which);
      Series c{};
      for (int j = 0; j <= y.degree; ++j) c[j] = w[0] * y.i[0][j] + w[1] * y.i[1][j] + w[2] * y.i[2][j];
      const rig::BoardCommand& command = rig.modulator().command();
      // The sign of the reference is part of what is watched: a reversal changes which current is compared.
      const double upper = rig.setpoint() < 0.0 ? -command.off_above_A : command.off_above_A;
      part(watched_[which], series::restricted(c, y.degree, 0.0, s), y.degree, rig.plant().sector(), upper,
           command.on_below_A, command.off_above_A);
    }
  }
  const HysteresisFigures& figures() const { return figures_; }

 private:
  /// What one comparator has seen last. A new reference excuses both limits until the current is back in the
  /// band, a sector edge only the lower one: the mean of two phases drops there, it has no reason to rise.
  struct Watched {
    int sector = -1;
    double key = 0.0;  ///< upper limit with the sign of the reference
    bool excused_above = true, excused_below = true;
  };
  void part(Watched& watched, const Series& c, int degree, int sector, double key, double lower,
            double upper);

  HysteresisFigures figures_;
  Watched watched_[2]{};
};

}  // namespace sixstep::study

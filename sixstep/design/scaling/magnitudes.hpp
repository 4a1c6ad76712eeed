// SPDX-License-Identifier: Apache-2.0
// Largest magnitudes in a drive's loops, in SI units, by interval arithmetic around 0 that follows the lines
// of drive.hpp.
#pragma once
#include "sixstep/design/scaling/scaling.hpp"

namespace sixstep::design::detail {

struct Magnitudes {
  double current = 0.0;  ///< phase and motor current
  double current_ref = 0.0;
  double current_levels = 0.0;  ///< current reference plus the band
  double speed = 0.0;
  double speed_ref = 0.0;
  double speed_change = 0.0;  ///< change of the speed from sample to sample
  double position = 0.0;
  double position_ref = 0.0;
  double voltage = 0.0;  ///< limit of the current PI
  double emf = 0.0;      ///< feed-forward, clamped at the PI's limit
  double bus = 0.0;
};

Magnitudes magnitudes(const control::DriveConfig<double>& drive, const OperatingRange& range);

}  // namespace sixstep::design::detail

// SPDX-License-Identifier: Apache-2.0
// What the product drive watches and how it starts and stops (control/protected_drive.hpp), as a scenario
// says it. What each key means stands in protection_description.hpp.
#pragma once
#include <optional>

namespace sixstep::study {

/// Before it runs, a fixed pair pulls the rotor, to prove that phases and probes are wired as told.
struct Align {
  std::optional<double> current_A;  // without it there is no alignment
  double longest_s = 0.5;
  double settled_s = 0.02;
  int sector = 0;
};

struct Protection {
  std::optional<double> over_current_A, over_voltage_V, under_voltage_V, over_speed_rad_s;
  int voltage_samples = 3;
  std::optional<double> stall_current_A, stall_s;  // without them stalling is not watched
  std::optional<double> offset_tolerance_A;
  Align align;
  double brake_current_A = 0.0;
  std::optional<double> short_below_rad_s;
  double standing_rad_s = 0.0;
  std::optional<double> off_at_s;  // when the request to run is let go
};

}  // namespace sixstep::study

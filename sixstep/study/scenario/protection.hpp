// SPDX-License-Identifier: Apache-2.0
// Monitoring, start and stop of the product drive (control/protected_drive.hpp) in a scenario.
// protection_description.hpp describes each key.
#pragma once
#include <optional>

namespace sixstep::study {

/// Alignment before the run: the current through a fixed pair turns the rotor to a known angle, to prove that
/// phases and probes are wired as given.
struct Align {
  std::optional<double> current_A;  // not given: no alignment
  double longest_s = 0.5;
  double settled_s = 0.02;
  int sector = 0;
};

struct Protection {
  std::optional<double> over_current_A, over_voltage_V, under_voltage_V, over_speed_rad_s;
  int voltage_samples = 3;
  std::optional<double> stall_current_A, stall_s;  // not given: stalling is not detected
  std::optional<double> offset_tolerance_A;
  Align align;
  double brake_current_A = 0.0;
  std::optional<double> short_below_rad_s;
  double standing_rad_s = 0.0;
  std::optional<double> off_at_s;  // time at which the request to run ends
};

}  // namespace sixstep::study

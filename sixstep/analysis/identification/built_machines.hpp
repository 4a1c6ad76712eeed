// SPDX-License-Identifier: Apache-2.0
// What brushless machines are built as: what a recording is held to before its constants are told. What a file may say
// (base/plausible.hpp) is wider, for there a number stands alone; a recording's constant is a quotient, in which a
// unit of time or voltage that was taken for another makes a factor of 1000.
#pragma once
#include "sixstep/base/describe.hpp"
#include "sixstep/base/problem.hpp"

namespace sixstep::analysis {

/// Peak between two lines over the shaft's speed, mV s/rad. The smallest motors, 2 to 3 mm across, turn 60 000 rpm and more
/// with a volt or less: 0.05 to 0.5. A direct-drive wind generator of 3 MW has 690 V rms at 15 rpm: 620 000; traction and
/// ship motors lie below it.
inline constexpr base::Range built_line_mV_s = base::between(0.02, 1e6);

/// rpm of the shaft. Dental turbines and turbo compressors end at 500 000; what is slower than a turn in 100 minutes shows no
/// voltage to measure a constant by.
inline constexpr base::Range built_shaft_rpm = base::between(0.01, 6e5);

/// Of the voltage, where the pole pairs are not known. 500 000 rpm are 8.3 kHz with one pole pair, and with more a machine
/// turns slower, for its iron: nothing is built for twice as much.
inline constexpr double most_built_Hz = 2e4;

/// A speed that no shaft has; `pole_pairs` 0: not known. Units: Hz of the voltage.
base::Problems check_built_speed(double electrical_Hz, int pole_pairs);

/// A back-EMF that no machine has. `line_peak_V_s` per electrical rad/s; `pole_pairs` as above.
base::Problems check_built_constant(double line_peak_V_s, double electrical_Hz, int pole_pairs);

}  // namespace sixstep::analysis

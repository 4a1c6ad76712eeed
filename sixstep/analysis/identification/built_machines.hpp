// SPDX-License-Identifier: Apache-2.0
// Limits of built brushless machines, against which the constants of a recording are checked. They are
// narrower than the limits of a number in a file (base/plausible.hpp). A recording's constant is a quotient:
// a wrong unit of time or voltage changes it by a factor of 1000.
#pragma once
#include "sixstep/base/describe.hpp"
#include "sixstep/base/problem.hpp"

namespace sixstep::analysis {

/// Peak line-to-line voltage divided by the shaft's speed, mV s/rad. The smallest motors (2 to 3 mm across,
/// 60 000 rpm and more, a volt or less) have 0.05 to 0.5. A direct-drive wind generator of 3 MW with 690 V
/// rms at 15 rpm has 620 000. Traction and ship motors have smaller values.
inline constexpr base::Range built_line_mV_s = base::between(0.02, 1e6);

/// Speed of the shaft, rpm. Dental turbines and turbo compressors reach 500 000. A shaft slower than a turn
/// in 100 minutes induces no measurable voltage.
inline constexpr base::Range built_shaft_rpm = base::between(0.01, 6e5);

/// Upper limit of the voltage's frequency in Hz if the pole pairs are unknown. 500 000 rpm are 8.3 kHz with
/// one pole pair; machines with more pole pairs turn slower, because of iron losses. The limit is more than
/// twice this frequency.
inline constexpr double most_built_Hz = 2e4;

/// A Problem for a speed that no shaft has; `pole_pairs` 0: unknown.
base::Problems check_built_speed(double electrical_Hz, int pole_pairs);

/// A Problem for a back-EMF that no machine has. `line_peak_V_s` per electrical rad/s; `pole_pairs` as above.
base::Problems check_built_constant(double line_peak_V_s, double electrical_Hz, int pole_pairs);

}  // namespace sixstep::analysis

// SPDX-License-Identifier: Apache-2.0
// Names the well-known factors between two printed forms of one value: frame, unit, point.
#pragma once
#include <cmath>
#include <string>
#include <string_view>

namespace sixstep::design {

struct Factor {
  double ratio;
  std::string_view words;
  bool of_frames = true;  ///< true: applies only to constants with a frame: terminal or phase, peak or rms
};
inline constexpr Factor well_known_factors[] = {
    {2.0, "a factor 2: terminal against phase?"},
    {1.7320508075688772, "a factor sqrt 3: line against phase?"},
    {1.4142135623730951, "a factor sqrt 2: peak against rms?"},
    {2.449489742783178, "a factor sqrt 6: line peak against phase rms?"},
    {1.5, "a factor 3/2: torque of the q axis against one phase's EMF?"},
    {10.0, "a factor 10: a misplaced decimal point, or a wrong unit?", false},
    {1000.0, "a factor 1000: a wrong unit?", false},
};

/// Text for a ratio that is a well-known factor within the rounding, at least half a percent; the nearest two
/// of these factors are 6 % apart.
inline std::string well_known_factor(double ratio, double rounding, bool frames) {
  const double size = ratio < 1.0 ? 1.0 / ratio : ratio, reach = rounding > 0.005 ? rounding : 0.005;
  for (const Factor& factor : well_known_factors)
    if ((frames || !factor.of_frames) && std::abs(size / factor.ratio - 1.0) <= reach)
      return std::string(factor.words);
  return "";
}

}  // namespace sixstep::design

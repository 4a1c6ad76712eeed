// SPDX-License-Identifier: Apache-2.0
// What a designer asks of a sampled loop: margins, bandwidth, peak of sensitivity, Bode data, step response.
// For any ratio of polynomials, so that inner loops, delay and hold can be counted in; margins.hpp is the
// closed form for a loop taken alone.
#pragma once
#include <limits>
#include <optional>
#include <vector>

#include "sixstep/design/loops/rotor_sensing.hpp"
#include "sixstep/design/loops/transfer.hpp"

namespace sixstep::design {

struct LoopFigures {
  bool stable = false;                    ///< the closed loop, by its poles
  std::optional<double> crossover_rad_s;  ///< the last frequency where |L| falls through 1
  std::optional<double> phase_rad;        ///< least distance to -180 degrees where |L| = 1
  std::optional<double> gain;             ///< factor on the gain that makes it unstable; empty: none above 1
  std::optional<double> delay_s;          ///< extra dead time that makes it unstable; 0 where it is already
  std::optional<double> bandwidth_rad_s;  ///< where |L/(1 + L)| falls below 1/sqrt 2
  double sensitivity_peak = 1.0;          ///< largest |1/(1 + L)|; 1/peak is the distance to -1
  double sensitivity_peak_rad_s = 0.0;
};

/// Scanned on a logarithmic grid of `points` from the slowest root up to half the sampling rate, crossings
/// refined to rounding. A resonance narrower than a grid step (0.2 % of its frequency with the default) could
/// hide from the peak of sensitivity; a PI loop has none.
LoopFigures loop_figures(const Transfer& loop, double period_s, int points = 4096);

/// A loop that sees its speed through a sensor: L H. With `around`, a loop around that speed loop,
/// `loop` (1 + around)/(1 + around H), which sees its own quantity as it is.
struct SensedLoop {
  Transfer loop;
  SpeedLag lag;
  std::optional<Transfer> around{};
};

/// The same figures with the sensor's lag. `stable`: the loop is so without the lag, and no crossing has lost
/// its phase to it.
LoopFigures sensed_figures(const SensedLoop& sensed, double period_s, int points = 4096);

struct BodePoint {
  double w_rad_s = 0.0;
  double gain = 0.0, phase_rad = 0.0;  ///< of L, phase unwrapped from the lowest frequency on
  double closed_gain = 0.0;            ///< |L/(1 + L)|
};
std::vector<BodePoint> bode(const Transfer& loop, double period_s, double from_rad_s, int points);

/// A unit step of the reference of the closed loop, at the samples.
struct StepResponse {
  std::vector<double> samples;                                  ///< from the instant of the step on
  double settling_s = std::numeric_limits<double>::infinity();  ///< last exit from +-band; infinite where
                                                                ///< `seconds` do not suffice
  /// Part of the step; infinite of a loop that is not stable, whose samples are empty.
  double overshoot = std::numeric_limits<double>::infinity();
  std::optional<double> reach_s;  ///< first sample at 98 %
};
/// Settled from the first sample on after which each lies inside the band, as study's gauge counts.
StepResponse step_response(const Transfer& closed_loop, double period_s, double seconds, double band = 0.02);
/// The same of a loop, given open, whose controller sees the output through the lag, in whole periods.
StepResponse sensed_step(const SensedLoop& sensed, double period_s, double seconds, double band = 0.02);

}  // namespace sixstep::design

// SPDX-License-Identifier: Apache-2.0
// Computes the figures of a sampled loop: margins, bandwidth, peak of sensitivity, Bode data, step response.
// The loop is any ratio of polynomials, with inner loops, delay and hold included. margins.hpp contains the
// closed form for a single loop.
#pragma once
#include <limits>
#include <optional>
#include <vector>

#include "sixstep/design/loops/rotor_sensing.hpp"
#include "sixstep/design/loops/transfer.hpp"

namespace sixstep::design {

struct LoopFigures {
  bool stable = false;                    ///< true: the closed loop is stable, by its poles
  std::optional<double> crossover_rad_s;  ///< last frequency at which |L| falls through 1
  std::optional<double> phase_rad;        ///< smallest phase distance to -180 degrees at which |L| = 1
  std::optional<double> gain;             ///< factor on the gain at which the loop becomes unstable; empty:
                                          ///< no factor above 1
  std::optional<double> delay_s;  ///< additional dead time at which the loop becomes unstable; 0 if the loop
                                  ///< is unstable without additional dead time
  std::optional<double> bandwidth_rad_s;  ///< frequency at which |L/(1 + L)| falls below 1/sqrt 2
  double sensitivity_peak = 1.0;          ///< largest |1/(1 + L)|; its inverse is the distance of L to -1
  double sensitivity_peak_rad_s = 0.0;
};

/// Scans a logarithmic grid of `points` from the slowest root to half the sampling rate, and refines
/// crossings to rounding. The peak of sensitivity may miss a resonance narrower than a grid step (0.2 % of
/// its frequency by default); a PI loop has no such resonance.
LoopFigures loop_figures(const Transfer& loop, double period_s, int points = 4096);

/// A loop with a speed sensor H: the open loop is L H. With `around`, it is a position loop around this speed
/// loop: `loop` (1 + around)/(1 + around H). The position itself is measured without lag.
struct SensedLoop {
  Transfer loop;
  SpeedLag lag;
  std::optional<Transfer> around{};
};

/// Figures of a loop with its sensor's lag. `stable`: the loop is stable without the lag, and at each
/// crossing the phase margin with the lag is above 0.
LoopFigures sensed_figures(const SensedLoop& sensed, double period_s, int points = 4096);

struct BodePoint {
  double w_rad_s = 0.0;
  double gain = 0.0, phase_rad = 0.0;  ///< |L| and arg L; the phase is unwrapped from the lowest frequency on
  double closed_gain = 0.0;            ///< |L/(1 + L)|
};
std::vector<BodePoint> bode(const Transfer& loop, double period_s, double from_rad_s, int points);

/// Response of the closed loop to a unit step of its reference, at the samples.
struct StepResponse {
  std::vector<double> samples;                                  ///< output from the instant of the step on
  double settling_s = std::numeric_limits<double>::infinity();  ///< last exit from +-band; infinite if
                                                                ///< `seconds` do not suffice
  /// Overshoot relative to the step; infinite for an unstable loop, which has no samples.
  double overshoot = std::numeric_limits<double>::infinity();
  std::optional<double> reach_s;  ///< time of the first sample at or above 98 %
};
/// The step counts as settled from the first sample after which all samples are within the band, as in
/// study's gauge.
StepResponse step_response(const Transfer& closed_loop, double period_s, double seconds, double band = 0.02);
/// Step response of a loop whose controller measures the output through the sensor's lag, in whole periods.
StepResponse sensed_step(const SensedLoop& sensed, double period_s, double seconds, double band = 0.02);

}  // namespace sixstep::design

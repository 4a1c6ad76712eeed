// SPDX-License-Identifier: Apache-2.0
// Which frequencies a curve is made of, once the drive has settled.
#pragma once
#include <complex>
#include <optional>
#include <string>
#include <vector>

#include "report/thinning.hpp"
#include "sixstep/study/measure/trace.hpp"
#include "sixstep/study/scenario/scenario.hpp"

namespace report {

/// Where a spectrum is taken: the later half of the last stretch with one setpoint, 4096 PWM periods at most,
/// shortened to whole electrical turns where the rotor makes any, so that harmonics of the electrical
/// frequency lie on lines.
struct Stretch {
  Interval time;
  long long turns = 0;  ///< electrical
};
/// Empty where it is shorter than 64 PWM periods: too few to tell frequencies apart.
std::optional<Stretch> steady_stretch(const sixstep::study::Trace& trace,
                                      const sixstep::study::Scenario& scenario, double pole_pairs);

/// A pure tone: where it is, in lines, which may be between two, and its amplitude (peak value).
struct Tone {
  double line = 0.0, amplitude = 0.0;
};

/// In the column's unit: below it there is none, but what roundings leave.
inline constexpr double least_tone = 1e-9;

/// Amplitude (peak value) of the line k at k/duration. A Hann window widens a pure tone to three lines. Between two lines its highest
/// one would be up to 15 % too low: from the two highest the tone's own place and amplitude are computed, and its highest line has that.
struct Lines {
  double spacing_Hz = 0.0, cell_s = 0.0;
  std::vector<double> amplitude{};  ///< up to an eighth of the cells' frequency; [0], the mean, is 0
  std::vector<Tone>
      tones{};  ///< the strongest first, none below a thousandth of it or least_tone, in the leakage of a stronger one, or on
  ///< the first line, where a drift shows, too
};
/// Of the straight lines between the rows, averaged exactly over equal cells no longer than `cell_s` (which
/// damps what lies above their frequency instead of folding it down; the damping below is divided out again).
Lines lines_of(const std::vector<double>& time, const std::vector<double>& values, const Interval& stretch,
               double cell_s);

/// "6 × electrical", "PWM", "PWM − 2 × electrical", "beside 3 × PWM"; empty where it is none of these. K PWM
/// periods in the stretch, 0 where nothing beats time.
std::string origin_of(double line, long long turns, double periods);

/// In place, decimation in time; the size is a power of two.
void transform(std::vector<std::complex<double>>& values);

}  // namespace report

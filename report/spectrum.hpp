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

/// Amplitude (peak value) of the line k at k/duration. A Hann window widens a pure tone to three lines, whose
/// middle one has its amplitude where it lies on a line, and at worst 15 % less between two.
struct Lines {
  double spacing_Hz = 0.0, cell_s = 0.0;
  std::vector<double> amplitude{};  ///< up to an eighth of the cells' frequency; [0], the mean, is 0
};
/// Of the straight lines between the rows, averaged exactly over equal cells no longer than `cell_s` (which
/// damps what lies above their frequency instead of folding it down; the damping below is divided out again).
Lines lines_of(const std::vector<double>& time, const std::vector<double>& values, const Interval& stretch,
               double cell_s);

/// The strongest lines: none within four of a stronger one, none below a thousandth of the strongest.
std::vector<std::size_t> strongest(const Lines& lines, std::size_t most);

/// "6 × electrical", "PWM", "PWM − 2 × electrical", "beside 3 × PWM"; empty where it is none of these. K PWM
/// periods in the stretch, 0 where nothing beats time.
std::string origin_of(std::size_t line, long long turns, double periods);

/// In place, decimation in time; the size is a power of two.
void transform(std::vector<std::complex<double>>& values);

}  // namespace report

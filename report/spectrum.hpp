// SPDX-License-Identifier: Apache-2.0
// Computes the spectrum of a curve after the drive has settled.
#pragma once
#include <complex>
#include <optional>
#include <string>
#include <vector>

#include "report/thinning.hpp"
#include "sixstep/study/measure/trace.hpp"
#include "sixstep/study/scenario/scenario.hpp"

namespace report {

/// The stretch of the spectrum: the later half of the last stretch with one setpoint, at most 4096 PWM periods.
/// If the rotor turns, it is shortened to whole electrical turns, so that harmonics of the electrical frequency
/// fall on lines.
struct Stretch {
  Interval time;
  long long turns = 0;  ///< electrical
  double part = 0.0;    ///< fraction of an electrical turn, if the stretch is shorter than one turn
};
/// Empty if shorter than 64 PWM periods, which do not resolve frequencies.
std::optional<Stretch> steady_stretch(const sixstep::study::Trace& trace,
                                      const sixstep::study::Scenario& scenario, double pole_pairs);

/// A pure tone: its place in lines, possibly between two, and its amplitude (peak value).
struct Tone {
  double line = 0.0, amplitude = 0.0;
};

/// Least amplitude in the column's unit; smaller amplitudes are only rounding.
inline constexpr double least_tone = 1e-9;

/// Amplitude (peak value) of line k at k/duration. A Hann window widens a pure tone to three lines. Between two
/// lines the highest one would be up to 15 % too low; therefore the tone's place and amplitude are computed from
/// the two highest lines, and the highest line gets that amplitude.
struct Lines {
  double spacing_Hz = 0.0, cell_s = 0.0;
  std::vector<double> amplitude{};  ///< up to an eighth of the cells' frequency; [0], the mean, is 0
  std::vector<Tone>
      tones{};  ///< strongest first; without tones below a thousandth of it or least_tone, in the leakage of a
                ///< stronger one, or on the first line, where a drift shows too
};
/// The spectrum of the straight lines between the rows. They are averaged exactly over equal cells no longer
/// than `cell_s`, which damps higher frequencies instead of folding them down; the damping of the lower ones is
/// divided out again.
Lines lines_of(const std::vector<double>& time, const std::vector<double>& values, const Interval& stretch,
               double cell_s);

/// The periodic causes of tones, as their number in the stretch; 0: absent.
struct Causes {
  long long turns = 0;      ///< electrical
  double periods = 0.0;     ///< of the PWM
  double heat_steps = 0.0;  ///< of the thermal model
};
/// "6 × electrical", "PWM", "PWM − 2 × electrical", "2 × step of the thermal model", "beside 3 × PWM"; empty for
/// any other line. The line of a named cause is exact; that of any other tone is where it was found.
struct Origin {
  std::string name;
  double line = 0.0;
};
Origin origin_of(double line, const Causes& causes);

/// Fast Fourier transform in place, decimation in time; the size is a power of two.
void transform(std::vector<std::complex<double>>& values);

}  // namespace report

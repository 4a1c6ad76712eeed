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

/// Fewest electrical turns that resolve the electrical frequency. The first line is left out, because a drift
/// over the stretch appears there. With a single turn, the first line would be the fundamental.
inline constexpr double fewest_turns = 2.0;

/// The stretch of time from which a spectrum is computed: the later half of the last interval with a constant
/// setpoint, at most 4096 PWM periods. If the rotor turns, the stretch is shortened to whole electrical
/// turns, so that harmonics of the electrical frequency coincide with lines.
struct Stretch {
  Interval time;
  long long turns = 0;  ///< number of electrical turns
  double part = 0.0;    ///< electrical turns, if the stretch has fewer than `fewest_turns`
};
/// The stretch. Empty if it is shorter than 64 PWM periods, which do not resolve frequencies.
std::optional<Stretch> steady_stretch(const sixstep::study::Trace& trace,
                                      const sixstep::study::Scenario& scenario, double pole_pairs);

/// A pure tone: its frequency as a line number, which need not be whole, and its amplitude (peak value).
struct Tone {
  double line = 0.0, amplitude = 0.0;
};

/// Least amplitude in the column's unit. Smaller amplitudes are only rounding errors.
inline constexpr double least_tone = 1e-9;

/// Amplitudes (peak values); line k is the frequency k/duration. The Hann window widens a pure tone to three
/// lines. If a tone is between two lines, the highest line is up to 15 % too low. Therefore frequency and
/// amplitude of the tone are computed from the two highest lines, and the highest line is set to this
/// amplitude.
struct Lines {
  double spacing_Hz = 0.0, cell_s = 0.0;
  std::vector<double> amplitude{};  ///< up to an eighth of the cells' frequency; [0], the mean, is set to 0
  std::vector<Tone>
      tones{};  ///< strongest first. Omitted are tones below least_tone or a thousandth of the strongest
                ///< tone, tones within the leakage of a stronger tone, and the first line, where a drift
                ///< appears too
};
/// The spectrum of the polyline through the rows. The polyline is averaged exactly over equal cells of at
/// most `cell_s`. The averaging damps frequencies that would alias. Its damping of the lower frequencies is
/// corrected.
Lines lines_of(const std::vector<double>& time, const std::vector<double>& values, const Interval& stretch,
               double cell_s);

/// The periodic causes of tones. Each number is the cause's number of periods in the stretch; 0: absent.
struct Causes {
  long long turns = 0;      ///< number of electrical turns
  double periods = 0.0;     ///< number of PWM periods
  double heat_steps = 0.0;  ///< number of steps of the thermal model
  double mains = 0.0;       ///< number of periods of the mains behind a rectifier
  double switchings = 0.0;  ///< number of turn-ons by comparators, whose frequency depends on the motor
};
/// "6 × electrical", "PWM", "PWM − 2 × electrical", "2 × switching", "beside switching", "2 × step of the
/// thermal model", "beside 3 × PWM"; empty for any other line. The line number of a named cause is exact; the
/// line number of any other tone is measured.
struct Origin {
  std::string name;
  double line = 0.0;
};
Origin origin_of(double line, const Causes& causes);

/// Fast Fourier transform in place, decimation in time; the size is a power of two.
void transform(std::vector<std::complex<double>>& values);

}  // namespace report

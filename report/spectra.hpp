// SPDX-License-Identifier: Apache-2.0
// The spectra a report shows: phase current and torque.
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "report/spectrum.hpp"
#include "sixstep/study/measure/trace.hpp"

namespace report {

struct DrawnSpectrum {
  std::string id, title, quantity, unit, label, style;
  Lines lines;
};

struct Spectra {
  Stretch stretch;
  double period_s = 0.0;  ///< of the PWM; 0 where comparators switch
  std::vector<DrawnSpectrum> all;
};

/// Empty where the run has no steady stretch, or nothing moves there.
std::optional<Spectra> spectra(const sixstep::study::Trace& trace, const sixstep::study::Scenario& scenario,
                               double pole_pairs);

/// How they were taken, in words, and their strongest lines as tables.
std::string spectra_section(const std::optional<Spectra>& spectra);

/// The lines a chart draws: frequency in Hz and amplitude, the highest of each of some 1500 equal steps of
/// the logarithmic axis.
struct Drawn {
  std::vector<double> frequency_Hz, amplitude;
};
Drawn drawn_lines(const Lines& lines);

}  // namespace report

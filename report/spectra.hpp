// SPDX-License-Identifier: Apache-2.0
// Computes the spectra that a report shows: of phase current and torque.
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
  double period_s = 0.0;      ///< period of the PWM; 0 if comparators switch
  double switching_Hz = 0.0;  ///< measured frequency of comparators in the stretch; 0 with a PWM
  double heat_step_s = 0.0;   ///< step of the thermal model, which changes the resistance; 0 without it
  double mains_Hz = 0.0;      ///< 0: the bus has another source
  std::vector<DrawnSpectrum> all;
};

/// The spectra. Empty if the run has no steady stretch, or if no signal changes in it.
std::optional<Spectra> spectra(const sixstep::study::Trace& trace, const sixstep::study::Scenario& scenario,
                               double pole_pairs);

/// Describes the method, with the strongest lines as tables.
std::string spectra_section(const std::optional<Spectra>& spectra);

/// The lines that a chart draws: frequency in Hz and amplitude. The logarithmic axis is divided into about
/// 1500 equal steps, and each step shows its highest line.
struct Drawn {
  std::vector<double> frequency_Hz, amplitude;
};
Drawn drawn_lines(const Lines& lines);

}  // namespace report

// SPDX-License-Identifier: Apache-2.0
// Writes a trace as the JSON that report.js draws.
#pragma once
#include <cstddef>
#include <optional>
#include <string>

#include "report/spectra.hpp"
#include "sixstep/study/measure/trace.hpp"
#include "sixstep/study/scenario/scenario.hpp"

namespace report {

/// Largest number of rows per chart. If a run has more than `full` rows, the page contains an envelope of at
/// most `cap` rows and all rows in packed form. If the packed rows are too large, the page contains only the
/// rows of the close-ups.
struct PlotSize {
  std::size_t cap = 6000;
  std::size_t full = 16000;
  std::size_t packed_bytes = 5'000'000;  ///< largest size of all packed rows, bytes; base64 adds a third
};

/// {"run":[t0,t1], "windows":[..], "axes":[base64 float64..], "charts":[{.., "curves":[{.., "data": base64
/// float32}]}]}
std::string plot_data(const sixstep::study::Trace& trace, const sixstep::study::Scenario& scenario,
                      double pole_pairs, PlotSize size = {},
                      const std::optional<Spectra>& spectra = std::nullopt);

}  // namespace report

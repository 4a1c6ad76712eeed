// SPDX-License-Identifier: Apache-2.0
// Writes a trace as the JSON from which report.js draws.
#pragma once
#include <cstddef>
#include <optional>
#include <string>

#include "report/spectra.hpp"
#include "sixstep/study/measure/trace.hpp"
#include "sixstep/study/scenario/scenario.hpp"

namespace report {

/// Largest number of rows per chart. With more than `full` rows, the page has an envelope of at most `cap`
/// rows, and in addition every packed row. If these are too large, it has every row of the close-ups only.
struct PlotSize {
  std::size_t cap = 6000;
  std::size_t full = 16000;
  std::size_t packed_bytes = 5'000'000;  ///< largest size of all packed rows; base64 adds a third
};

/// {"run":[t0,t1], "windows":[..], "axes":[base64 float64..], "charts":[{.., "curves":[{.., "data": base64
/// float32}]}]}
std::string plot_data(const sixstep::study::Trace& trace, const sixstep::study::Scenario& scenario,
                      double pole_pairs, PlotSize size = {},
                      const std::optional<Spectra>& spectra = std::nullopt);

}  // namespace report

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

/// Rows per chart. Above `full`: an envelope of at most `cap` rows, and every row packed; if that is too large,
/// every row of the close-ups.
struct PlotSize {
  std::size_t cap = 6000;
  std::size_t full = 16000;
  std::size_t packed_bytes = 5'000'000;  ///< limit of all packed rows; base64 adds a third
};

/// {"run":[t0,t1], "windows":[..], "axes":[base64 float64..], "charts":[{.., "curves":[{.., "data": base64
/// float32}]}]}
std::string plot_data(const sixstep::study::Trace& trace, const sixstep::study::Scenario& scenario,
                      double pole_pairs, PlotSize size = {},
                      const std::optional<Spectra>& spectra = std::nullopt);

}  // namespace report

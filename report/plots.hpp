// SPDX-License-Identifier: Apache-2.0
// Trace -> the JSON that report.js draws from.
#pragma once
#include <cstddef>
#include <optional>
#include <string>

#include "report/spectra.hpp"
#include "sixstep/study/measure/trace.hpp"
#include "sixstep/study/scenario/scenario.hpp"

namespace report {

/// Rows per chart: above `full`, an envelope of at most `cap` rows, and beside it every row, packed; where
/// that is too much to send, every row of the close-ups.
struct PlotSize {
  std::size_t cap = 6000;
  std::size_t full = 16000;
  std::size_t packed_bytes = 5'000'000;  ///< of every row, where they are more; text makes it a third more
};

/// {"run":[t0,t1], "windows":[..], "axes":[base64 float64..], "charts":[{.., "curves":[{.., "data": base64
/// float32}]}]}
std::string plot_data(const sixstep::study::Trace& trace, const sixstep::study::Scenario& scenario,
                      double pole_pairs, PlotSize size = {},
                      const std::optional<Spectra>& spectra = std::nullopt);

}  // namespace report

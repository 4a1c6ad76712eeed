// SPDX-License-Identifier: Apache-2.0
// Prints a measured frequency response with the designed one: for a terminal, as CSV and as JSON.
#pragma once
#include <string>
#include <string_view>
#include <vector>

#include "sixstep/analysis/bode/bode_study.hpp"
#include "text/rooms.hpp"

namespace text {

/// Operating point, one line per frequency, and the measured and designed margins. `name` is the scenario's
/// name.
std::string bode_text(std::string_view name, const analysis::BodeStudy& study);
/// Frequencies in Hz, gains in dB, phases in degrees. The designed columns exist only if there is a linear
/// loop.
std::string bode_csv(const analysis::BodeStudy& study);
/// JSON in full precision. The same study gives the same bytes.
std::string bode_json(std::string_view name, const analysis::BodeStudy& study);

/// One line of the comparison of margins: its name, and both values with unit; "-" for a value that does not
/// exist.
struct BodeMargin {
  std::string name, measured, designed;
};
std::vector<BodeMargin> bode_margins(const analysis::BodeStudy& study);

/// The operating point in words: "current around 5 A, +-0.25 A".
std::string bode_place(const analysis::BodeStudy& study);
/// Notes on the measurement: frequencies without a line, lines of little coherence, the reason if there is no
/// designed loop.
std::vector<std::string> bode_notes(const analysis::BodeStudy& study);

}  // namespace text

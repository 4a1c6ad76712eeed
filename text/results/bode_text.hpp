// SPDX-License-Identifier: Apache-2.0
// A measured frequency response beside the designed one, for a terminal, a table and programs.
#pragma once
#include <string>
#include <string_view>
#include <vector>

#include "sixstep/analysis/bode/bode_study.hpp"
#include "text/rooms.hpp"

namespace text {

/// Operating point, a line per frequency, margins of both. `name`: of the scenario.
std::string bode_text(std::string_view name, const analysis::BodeStudy& study);
/// Frequencies in Hz, gains in dB, phases in degrees; designed columns only where there is a linear loop.
std::string bode_csv(const analysis::BodeStudy& study);
/// In full precision. The same study gives the same bytes.
std::string bode_json(std::string_view name, const analysis::BodeStudy& study);

/// One line of the comparison of margins: what it is, and both with their unit; "-" where there is none.
struct BodeMargin {
  std::string name, measured, designed;
};
std::vector<BodeMargin> bode_margins(const analysis::BodeStudy& study);

/// "current around 5 A, +-0.25 A"
std::string bode_place(const analysis::BodeStudy& study);
/// What is to be known of the measurement: what stands at no line, lines of little coherence, why there is no designed loop.
std::vector<std::string> bode_notes(const analysis::BodeStudy& study);

}  // namespace text

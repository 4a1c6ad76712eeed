// SPDX-License-Identifier: Apache-2.0
// Prints the results of a commissioning drive: for a terminal, as JSON, and as lines of a motor's file.
#pragma once
#include <string>

#include "sixstep/analysis/commission/commission_study.hpp"
#include "text/rooms.hpp"

namespace text {

/// The bench; each quantity that the chip found, with the motor's value, the error and its bound; the Hall
/// lines; the times of the phases; the quantities that were not found, and why.
std::string commission_text(const analysis::CommissionStudy& study);

/// JSON in full precision. The same study gives the same bytes.
std::string commission_json(const analysis::CommissionStudy& study);

/// Lines for the motor's file and for a scenario's sensors, without values that were not found.
std::string commission_toml(const analysis::CommissionStudy& study);

/// ", a fifth of the current at full duty: ..": the substitute for a nominal current that the sheet omits.
/// Empty if the sheet has a nominal current, or if the test current was given.
std::string stand_in_words(const analysis::CommissionBench& bench);

/// "spinning"; also the name in JSON.
std::string_view phase_word(sixstep::control::CommissioningPhase phase);
/// Why the chip stopped or has no table of the Hall lines, and the cure; empty if it found everything.
std::string commission_failure(const analysis::CommissionStudy& study);

}  // namespace text

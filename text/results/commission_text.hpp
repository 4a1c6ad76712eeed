// SPDX-License-Identifier: Apache-2.0
// Prints the results of a commissioning drive: for a terminal, as JSON, and as lines of a motor's file.
#pragma once
#include <string>

#include "sixstep/analysis/commission/commission_study.hpp"
#include "text/rooms.hpp"

namespace text {

/// Prints the study:
/// - the bench;
/// - each quantity that the chip found, with the motor's value, the error and its bound;
/// - the Hall lines;
/// - the times of the phases;
/// - the quantities that were not found, with the reasons.
std::string commission_text(const analysis::CommissionStudy& study);

/// JSON in full precision. The same study gives the same bytes.
std::string commission_json(const analysis::CommissionStudy& study);

/// Lines for the motor's file and for a scenario's sensors, without values that were not found.
std::string commission_toml(const analysis::CommissionStudy& study);

/// The substitute for a nominal current that the sheet omits, as ", a fifth of the current at full duty: ..".
/// Empty if the sheet has a nominal current, or if the test current was given.
std::string stand_in_words(const analysis::CommissionBench& bench);

/// The word for a phase, such as "spinning"; also its name in JSON.
std::string_view phase_word(sixstep::control::CommissioningPhase phase);
/// The reason why the chip stopped or has no table of the Hall lines, and the cure. Empty if it found
/// everything.
std::string commission_failure(const analysis::CommissionStudy& study);

}  // namespace text

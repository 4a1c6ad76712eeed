// SPDX-License-Identifier: Apache-2.0
// What a drive found out of what hangs at it, for a terminal, for programs and for a motor's file.
#pragma once
#include <string>

#include "sixstep/analysis/commission/commission_study.hpp"
#include "text/rooms.hpp"

namespace text {

/// The bench; each quantity as the chip found it, what the motor is, how far off and within which bound; the Hall lines; when
/// which phase was; what was not found, and why.
std::string commission_text(const analysis::CommissionStudy& study);

/// The same in full precision. The same study gives the same bytes.
std::string commission_json(const analysis::CommissionStudy& study);

/// Lines for the motor's file, and for a scenario's sensors; what was not found is left out.
std::string commission_toml(const analysis::CommissionStudy& study);

/// What stands in for a nominal current that the sheet does not name: ", twice a tenth of full duty's: ..". Empty where it does, and where
/// the current was asked for.
std::string stand_in_words(const analysis::CommissionBench& bench);

/// "spinning"; as a name for programs, too.
std::string_view phase_word(sixstep::control::CommissioningPhase phase);
/// Why the chip gave up, or why it has no table of the Hall lines, and what to do; empty where it found all.
std::string commission_failure(const analysis::CommissionStudy& study);

}  // namespace text

// SPDX-License-Identifier: Apache-2.0
// Writes the card with the costs of a run: its losses, and the number of switchings.
#pragma once
#include <array>
#include <optional>
#include <string>

#include "sixstep/study/measure/outcome.hpp"
#include "sixstep/study/measure/trace.hpp"

namespace report {

/// Turn-ons of the chopped switch per second, as in the figure of the same name; with a PWM, the PWM
/// frequency. 0 if each chopped switch was turned on at most once. All six switches together turn on more
/// often, because commutation also turns switches on, and so does complementary chopping.
double switching_frequency_Hz(const sixstep::study::Outcome& outcome);

/// Number of turn-ons of T1 to T6, counted from whole_from_s() on. A switch that is on in the first row
/// counts as turned on in this row.
std::optional<std::array<long long, 6>> turn_on_counts(const sixstep::study::Trace& trace);

/// The numbers of turn-ons as a clause for the card; empty if the trace has no gates.
std::string switching_words(const sixstep::study::Outcome& outcome, const sixstep::study::Trace& trace);

/// The content of the card; empty if no cost is known.
std::string cost_content(const sixstep::study::Outcome& outcome, const sixstep::study::Trace& trace);

}  // namespace report

// SPDX-License-Identifier: Apache-2.0
// Writes the card with the costs of a run: its losses, and how often it switched.
#pragma once
#include <array>
#include <optional>
#include <string>

#include "sixstep/study/measure/outcome.hpp"
#include "sixstep/study/measure/trace.hpp"

namespace report {

/// Turn-ons per second of the chopped switch, as in the figure of that name; with a PWM, its frequency. 0 if
/// each chopped switch was turned on at most once. All six switches together turn on more often: commutation
/// adds turn-ons, and so does the other switch of a leg with complementary chopping.
double switching_frequency_Hz(const sixstep::study::Outcome& outcome);

/// Number of turn-ons of T1 to T6 from whole_from_s() on. A switch that is on in the first row counts as
/// turned on there.
std::optional<std::array<long long, 6>> turn_on_counts(const sixstep::study::Trace& trace);

/// The turn-ons as half a sentence; empty if the trace has no gates.
std::string switching_words(const sixstep::study::Outcome& outcome, const sixstep::study::Trace& trace);

/// The content of the card; empty if no cost is known.
std::string cost_content(const sixstep::study::Outcome& outcome, const sixstep::study::Trace& trace);

}  // namespace report

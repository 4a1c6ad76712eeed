// SPDX-License-Identifier: Apache-2.0
// What a run cost, at first reading: where its energy went, and how often it switched.
#pragma once
#include <array>
#include <optional>
#include <string>

#include "sixstep/study/measure/outcome.hpp"
#include "sixstep/study/measure/trace.hpp"

namespace report {

/// Turn-ons per second of what is chopped, as the figure of that name: the PWM's frequency where a PWM chops. 0 where each switch was
/// turned on once at most: that is no chopping. All six switches together turn on more often: commutation turns on too, and the other
/// switch of a leg that is chopped complementarily.
double switching_frequency_Hz(const sixstep::study::Outcome& outcome);

/// Turn-ons of T1 to T6, from whole_from_s() on. What is on in the run's first row was turned on at its start.
std::optional<std::array<long long, 6>> turn_on_counts(const sixstep::study::Trace& trace);

/// In half a sentence; empty where the trace has no gates.
std::string switching_words(const sixstep::study::Outcome& outcome, const sixstep::study::Trace& trace);

/// The content of the card; empty where nothing is known.
std::string cost_content(const sixstep::study::Outcome& outcome, const sixstep::study::Trace& trace);

}  // namespace report

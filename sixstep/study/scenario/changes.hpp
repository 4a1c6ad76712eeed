// SPDX-License-Identifier: Apache-2.0
// What [[at]] makes of a scenario: which mode is in effect when, and the scenario as it is from an event on.
#pragma once
#include <vector>

#include "sixstep/study/scenario/scenario.hpp"

namespace sixstep::study {

/// Whether the chip is given another configuration.
inline bool retunes(const At& at) { return at.control != AtControl{} || at.pwm != AtPwm{}; }

/// The events in the order in which they happen; of two at one instant the one written first.
std::vector<const At*> in_order(const Scenario& scenario);

/// When an event happens. One that changes the mode waits for the control sample at or behind its time_s, so
/// that mode and reference change together.
double happens_at_s(const Scenario& scenario, const At& at);
/// The control sample at or behind an instant, on which the chip takes up another configuration.
std::int64_t sample_from_ticks(const Pwm& pwm, std::int64_t ticks);

/// The mode from each of scenario.at on.
std::vector<control::Mode> modes_from(const Scenario& scenario);
/// Whether a mode is in effect anywhere in the run.
bool comes_into(const Scenario& scenario, control::Mode mode);
bool changes_mode(const Scenario& scenario);

/// The scenario as if the chip had been so from the start: with what the events up to `event` (nullptr: none)
/// change of control, PWM and bridge, without such changes behind it, and with the references of its own mode
/// only.
Scenario settled(const Scenario& scenario, const At* event);

}  // namespace sixstep::study

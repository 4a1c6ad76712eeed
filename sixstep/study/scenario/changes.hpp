// SPDX-License-Identifier: Apache-2.0
// The effect of [[at]] on a scenario: its mode over time, and the scenario after an event.
#pragma once
#include <vector>

#include "sixstep/study/scenario/scenario.hpp"

namespace sixstep::study {

/// True if the chip's configuration changes at the event.
inline bool retunes(const At& at) { return at.control != AtControl{} || at.pwm != AtPwm{}; }

/// The events in time order. Two events at one instant keep their order in the file.
std::vector<const At*> in_order(const Scenario& scenario);

/// The time of an event, s. An event that changes the mode waits for the control sample at or after its
/// time_s, so that mode and reference change together.
double happens_at_s(const Scenario& scenario, const At& at);
/// The first control sample at or after `ticks`. The chip uses the configuration of an event at `ticks` from
/// this sample on.
std::int64_t sample_from_ticks(const Pwm& pwm, std::int64_t ticks);

/// The mode after each event of scenario.at.
std::vector<control::Mode> modes_from(const Scenario& scenario);
/// True if a mode is in effect at any time of the run.
bool comes_into(const Scenario& scenario, control::Mode mode);
bool changes_mode(const Scenario& scenario);

/// A scenario in which the configuration that the chip has after `event` (nullptr: before all events) applies
/// from the start. It includes the changes of control, PWM and dead time up to `event` and no later change of
/// these. A reference of another mode is replaced by 0.
Scenario settled(const Scenario& scenario, const At* event);

}  // namespace sixstep::study

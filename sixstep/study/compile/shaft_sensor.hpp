// SPDX-License-Identifier: Apache-2.0
// The encoder or resolver that a scenario asks for, as the board has it.
#pragma once
#include "sixstep/rig/registers.hpp"
#include "sixstep/study/scenario/scenario.hpp"

namespace sixstep::study {

/// Control periods from one peak of a resolver's excitation to the next: half an excitation's period, rounded.
int samples_per_peak(const Scenario& scenario);

/// Of the steps of the loop that follows a resolver: from peak to peak, or the clock of a converter chip.
double tracking_period_s(const Scenario& scenario);

/// How speed and position between Hall edges are found.
void take_hall_angle(const Scenario& scenario, rig::SensorsConfig& to);

/// Lines of a linear motor's scale to two pole pitches: check() holds them to a whole number.
double lines_to_period(const Scenario& scenario);

/// Of kind none where the Hall probes do, or nothing is sensed.
rig::ShaftSensorConfig shaft_sensor_config(const Scenario& scenario);

}  // namespace sixstep::study

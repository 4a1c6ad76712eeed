// SPDX-License-Identifier: Apache-2.0
// The board's encoder or resolver, from a scenario.
#pragma once
#include "sixstep/rig/registers.hpp"
#include "sixstep/study/scenario/scenario.hpp"

namespace sixstep::study {

/// Control periods between two peaks of a resolver's excitation: half an excitation period, rounded.
int samples_per_peak(const Scenario& scenario);

/// Step period in s of the loop that tracks a resolver: the time between two peaks, or the clock period of a
/// converter chip.
double tracking_period_s(const Scenario& scenario);

/// Copies the settings for speed and position between Hall edges.
void take_hall_angle(const Scenario& scenario, rig::SensorsConfig& to);

/// Lines of a linear motor's scale in two pole pitches; check() requires a whole number of them.
double lines_to_period(const Scenario& scenario);

/// Mounting offset of the sensor in use, electrical degrees; 0 if no sensor on the shaft is used.
double mounting_offset_deg(const Sensors& sensors);

/// Returns the sensor's configuration. The kind is `none` with Hall probes and without a sensor.
rig::ShaftSensorConfig shaft_sensor_config(const Scenario& scenario);

}  // namespace sixstep::study

// SPDX-License-Identifier: Apache-2.0
// What a board adds to a design that is put to the test: its sensors, and what they may do to the result.
#pragma once
#include "sixstep/design/loops/drive_design.hpp"
#include "sixstep/study/scenario/scenario.hpp"

namespace sixstep::analysis {

/// Sensors as boards have them, sized for the design: 12 bits for the phase currents (a quarter above what
/// the drive may ask for) and for the bus (half as much again), Hall probes. All ideal where the spec's rotor
/// is.
study::Sensors board_sensors(const design::DriveDesign& design);
/// Currents by another way, over the range that the design asks for where none is given.
void sense_currents(const design::DriveDesign& design, rig::CurrentMeasurement currents,
                    study::Sensors& sensors);

/// The same run with everything measured as it is: what the sensors cost is the difference.
study::Scenario with_ideal_sensors(study::Scenario scenario);

/// How far the speed may swing in steady state, peak to peak, before the loop oscillates: three times what
/// the commutations alone make of it (out of tolerance they make up to twice as much), or a twentieth of the
/// speed where that is more.
double allowed_swing_rad_s(double with_ideal_sensors_rad_s, double speed_rad_s);

/// A move may overshoot by so much out of tolerance: a hundredth of it; counted in Hall steps three of them.
double allowed_overshoot_deg(const design::DriveDesign& design, double move_deg);

}  // namespace sixstep::analysis

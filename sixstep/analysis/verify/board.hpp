// SPDX-License-Identifier: Apache-2.0
// What a board adds to a design that is put to the test: its sensors, and what they may do to the result.
#pragma once
#include <optional>

#include "sixstep/design/loops/drive_design.hpp"
#include "sixstep/study/scenario/scenario.hpp"

namespace sixstep::analysis {

/// Sensors as boards have them, sized for the design: 12 bits for the phase currents (a quarter above what
/// the drive may ask for; twice that for moves, which brake: the back-EMF then drives the current with the bus) and for the bus (half as much again), and the spec's rotor sensor with what its keys say where
/// nobody does. All ideal where the spec's rotor is.
/// `step`: what the run of a current loop asks for, where somebody said.
study::Sensors board_sensors(const design::DriveDesign& design, std::optional<double> step = {});
/// What sensors.rotor of a scenario is for it.
study::RotorSensing rotor_key(const design::RotorSensing& sensing);
/// The same sensors with another of the rotor's; a resolver that is sampled is excited so that its peaks are on control periods,
/// as near to what was asked for as that goes.
study::Sensors with_rotor(study::Sensors sensors, study::RotorSensing rotor, double period_s);
/// Currents by another way, over the range that the design asks for where none is given.
void sense_currents(const design::DriveDesign& design, rig::CurrentMeasurement currents,
                    std::optional<double> step, study::Sensors& sensors);

/// Whether the board's drive reads an encoder: to the product drive and to the sensorless one edges tell the rotor's place.
bool decodes_encoders(const std::optional<study::Scenario>& board);

/// What a board's control.limits and the thresholds of its protection leave a test: the most current that may be asked for, A, and the
/// most speed, a tenth below what trips it, rad/s. Empty where nothing bounds it.
std::optional<double> most_current_A(const study::Scenario& board, double K_t_Nm_A);
std::optional<double> most_speed_rad_s(const study::Scenario& board);

/// The same run with everything measured as it is: what the sensors cost is the difference.
study::Scenario with_ideal_sensors(study::Scenario scenario);

/// How far the speed may swing in steady state, peak to peak, before the loop oscillates: three times what
/// the commutations alone make of it (within the tolerances they make up to twice as much), or a twentieth of the
/// speed where that is more.
double allowed_swing_rad_s(double with_ideal_sensors_rad_s, double speed_rad_s);

/// A move may overshoot by so much, within the tolerances too: a hundredth of it; where the position is counted three steps of that.
double allowed_overshoot_deg(const design::DriveDesign& design, double move_deg);

}  // namespace sixstep::analysis

// SPDX-License-Identifier: Apache-2.0
// Gives a design's test the sensors of a board, and the bounds of their effect on the result.
#pragma once
#include <optional>

#include "sixstep/design/loops/drive_design.hpp"
#include "sixstep/study/scenario/scenario.hpp"

namespace sixstep::analysis {

/// Sensors of a usual board, sized for the design: 12 bits for the phase currents and for the bus, and the spec's
/// rotor sensor with the default values of its keys. The range of the currents is a quarter above the largest
/// current that the drive requests; for moves it is twice that current, because they brake, and the back-EMF
/// then drives the current with the bus. The range of the bus is 1.5 times its voltage. All sensors are ideal
/// where the spec's rotor sensor is. `step`: step of a current loop's run, where the user gave one.
study::Sensors board_sensors(const design::DriveDesign& design, std::optional<double> step = {});
/// The value of sensors.rotor in a scenario.
study::RotorSensing rotor_key(const design::RotorSensing& sensing);
/// The same sensors with another rotor sensor. A sampled resolver's excitation becomes the nearest one whose peaks
/// lie on control periods.
study::Sensors with_rotor(study::Sensors sensors, study::RotorSensing rotor, double period_s);
/// Sets the current measurement. If no range is given, it is that which the design requires.
void sense_currents(const design::DriveDesign& design, rig::CurrentMeasurement currents,
                    std::optional<double> step, study::Sensors& sensors);

/// Whether the board's drive reads an encoder. The product drive and the sensorless one find the rotor's
/// position by edges.
bool decodes_encoders(const std::optional<study::Scenario>& board);

/// Largest current, A, and largest speed, rad/s, that a board's control.limits and protection allow a test; the
/// speed is at least a tenth below the protection's threshold. Empty: no bound.
std::optional<double> most_current_A(const study::Scenario& board, double K_t_Nm_A);
std::optional<double> most_speed_rad_s(const study::Scenario& board);

/// The same run with ideal sensors; the difference is the effect of the sensors.
study::Scenario with_ideal_sensors(study::Scenario scenario);

/// Largest swing of the speed in steady state, peak to peak, that does not count as an oscillation of the
/// loop: three times the swing by the commutations alone (within the tolerances they cause up to twice as
/// much), or a twentieth of the speed if that is more.
double allowed_swing_rad_s(double with_ideal_sensors_rad_s, double speed_rad_s);

/// Largest overshoot of a move, within the tolerances too: a hundredth of it; with a position sensor of coarse
/// steps, three steps where that is more.
double allowed_overshoot_deg(const design::DriveDesign& design, double move_deg);

}  // namespace sixstep::analysis

// SPDX-License-Identifier: Apache-2.0
// Equips a design's test with the sensors of a board, and computes how much the sensors may affect the
// result.
#pragma once
#include <optional>

#include "sixstep/design/loops/drive_design.hpp"
#include "sixstep/study/scenario/scenario.hpp"

namespace sixstep::analysis {

/// Sensors of a usual board, sized for the design. All sensors are ideal if the spec's rotor sensor is ideal.
/// `step`: step of a current loop's run, if the user gave one.
/// - Converters of 12 bits for the phase currents and for the bus.
/// - The spec's rotor sensor with the default values of its keys.
/// - Range of the currents: 1.25 times the largest current that the drive requests. For moves it is twice
///   this current: while a move brakes, the back-EMF and the bus together drive the current.
/// - Range of the bus: 1.5 times its voltage.
study::Sensors board_sensors(const design::DriveDesign& design, std::optional<double> step = {});
/// The value of sensors.rotor in a scenario.
study::RotorSensing rotor_key(const design::RotorSensing& sensing);
/// The same sensors with another rotor sensor. The excitation of a sampled resolver is set to the nearest
/// frequency whose peaks lie on control periods.
study::Sensors with_rotor(study::Sensors sensors, study::RotorSensing rotor, double period_s);
/// Sets the current measurement. If no range is given, sets the range that the design requires.
void sense_currents(const design::DriveDesign& design, rig::CurrentMeasurement currents,
                    std::optional<double> step, study::Sensors& sensors);

/// True if the board's drive decodes an encoder. The product drive and the sensorless drive do not: they find
/// the rotor's position by edges.
bool decodes_encoders(const std::optional<study::Scenario>& board);

/// The largest current in A, and the largest speed in rad/s, that a board's control.limits and protection
/// allow in a test. The speed is at least a tenth below the protection's threshold. Empty: no bound.
std::optional<double> most_current_A(const study::Scenario& board, double K_t_Nm_A);
std::optional<double> most_speed_rad_s(const study::Scenario& board);

/// The same run with ideal sensors. The difference between the two runs is the effect of the sensors.
study::Scenario with_ideal_sensors(study::Scenario scenario);

/// Largest swing of the speed in steady state, peak to peak, that does not count as an oscillation of the
/// loop. It is the larger of two values: three times the swing by the commutations, and a twentieth of the
/// speed. The factor is three because within the tolerances commutations cause up to twice the swing.
double allowed_swing_rad_s(double with_ideal_sensors_rad_s, double speed_rad_s);

/// Largest allowed overshoot of a move, also within the tolerances: a hundredth of the move, or three steps
/// of the position sensor if they are larger.
double allowed_overshoot_deg(const design::DriveDesign& design, double move_deg);

}  // namespace sixstep::analysis

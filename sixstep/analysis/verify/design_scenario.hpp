// SPDX-License-Identifier: Apache-2.0
// A design put to the test: the scenario that runs it with all switching, and whose comparisons set what was
// designed beside what comes out.
#pragma once
#include <optional>
#include <string>

#include "sixstep/design/loops/drive_design.hpp"
#include "sixstep/study/measure/outcome.hpp"
#include "sixstep/study/scenario/scenario.hpp"

namespace sixstep::analysis {

/// What gate drivers of small bridges ask for.
inline constexpr double usual_dead_time_s = 0.5e-6;

struct DesignSubject {
  std::string motor{};    ///< name or path, as a scenario is to have it
  design::Sheet sheet{};  ///< of that motor
  /// The board it is run on: supply, bridge, PWM and sensors of this scenario. Else a stiff supply, ideal
  /// devices, and the sensors that board_sensors() puts on a board.
  std::optional<study::Scenario> board{};
  std::optional<rig::CurrentMeasurement> currents{};  ///< instead of what that board has
  /// Height of the step in the unit of the mode, as the motor's kind has it: of a linear one m/s and mm. Else one at which
  /// no limit acts (current, speed), usual_move().
  std::optional<double> step{};
  /// Of the bridge, where no board says it. A scenario that shall become a header is run with one: real bridges are shorted without.
  double dead_time_s = 0.0;
};

/// Names of figures that decide whether a design is usable.
inline constexpr const char *settling_of_start = "settling of the start",
                            *swing_at_target = "swing around the target";

/// What a position is moved by where nobody says: the thesis's 1000 degrees; in mm twenty pole pitches, which is as many commutations.
double usual_move(const design::DriveDesign& design);

/// - current: rotor held in the middle of a sector, a step of the setpoint; settling and overshoot at the
///   controller's samples, ripple of the last ten periods.
/// - speed: against half the nominal torque, so that the current flows without gaps: a start from rest, where
///   torque and bus limit, then a step so small that nothing does, which the linear design must estimate.
///   With Hall probes the step goes down to the lowest speed, where the speed is oldest, and is judged by a
///   band of a twentieth of that speed.
/// - position: one move; without a load, since a P controller leaves an error behind one.
/// Each comparison's value is what the design says, its source in words how.
study::Scenario design_scenario(const design::DriveDesign& design, const DesignSubject& subject);

/// Whether the subject's board samples in the middle of a period: where it says so, or where its one shunt would see nothing before
/// the on-time has begun.
bool samples_in_middle(const DesignSubject& subject);

/// Sets what a current loop's design foretells of settling time and overshoot in its scenario.
void expect_step(const design::DriveDesign& design, study::Scenario& scenario);

/// What a reader is shown of a figure: 0 where the design expects 0 and rounding alone is left of the step.
double as_read(const study::ComparisonResult& figure, const study::Scenario& scenario);

}  // namespace sixstep::analysis

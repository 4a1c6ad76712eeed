// SPDX-License-Identifier: Apache-2.0
// Creates the scenario that tests a design in a simulation with all switching. The scenario's comparisons
// compare designed with simulated values.
#pragma once
#include <optional>
#include <string>

#include "sixstep/design/loops/drive_design.hpp"
#include "sixstep/study/measure/outcome.hpp"
#include "sixstep/study/scenario/believed_motor.hpp"

namespace sixstep::analysis {

/// Dead time of usual gate drivers of small bridges, s.
inline constexpr double usual_dead_time_s = 0.5e-6;

struct DesignSubject {
  std::string motor{};    ///< name or path, for the scenario
  design::Sheet sheet{};  ///< sheet of the motor
  /// Source of supply, bridge, PWM and sensors of the run. Empty: a stiff supply, ideal devices, and the
  /// sensors of board_sensors().
  std::optional<study::Scenario> board{};
  std::optional<rig::CurrentMeasurement> currents{};  ///< replaces the current measurement of the board
  /// Height of the step in the unit of the mode; for a linear motor m/s and mm. Empty: a step at which no
  /// limit acts (current, speed), or usual_move().
  std::optional<double> step{};
  /// Dead time of the bridge in s if no board defines it. A scenario that becomes a header is run with a dead
  /// time, because a real bridge without dead time short-circuits.
  double dead_time_s = 0.0;

  /// Beliefs of the board's scenario, if it is for this motor.
  study::Believed believed() const {
    return board && board->motor == motor ? board->believed : study::Believed{};
  }
  /// The sheet for which the controller is designed; the run simulates `sheet`.
  design::Sheet believed_sheet() const { return study::believed_sheet(sheet, believed()); }
};

/// Names of figures that decide whether a design is usable.
inline constexpr const char *settling_of_start = "settling of the start",
                            *swing_at_target = "swing around the target";

/// The move of a position test without a given step: 1000 degrees, as in the thesis. For a linear motor it is
/// twenty pole pitches in mm, which are twenty commutation periods.
double usual_move(const design::DriveDesign& design);

/// Creates the test of a design. Each comparison's value is the designed value; its source names the method.
/// - Current: a step of the setpoint with the rotor held in the middle of a sector. It measures settling and
///   overshoot at the controller's samples, and the ripple of the last ten periods.
/// - Speed: a start from rest, limited by torque and bus, then a step so small that no limit acts; the linear
///   design must predict this step. The load is half the torque of the nominal current: the current is then
///   continuous. With Hall probes the step ends at the lowest speed, where the measured speed is oldest;
///   the settling band is a twentieth of this speed.
/// - Position: one move without a load, because a P controller has a steady error under load.
study::Scenario design_scenario(const design::DriveDesign& design, const DesignSubject& subject);

/// True if the subject's board samples in the middle of a period: by its configuration, or because its single
/// shunt would measure nothing before the on-time has begun.
bool samples_in_middle(const DesignSubject& subject);

/// Sets the settling time and the overshoot that a current loop's design predicts in its scenario.
void expect_step(const design::DriveDesign& design, study::Scenario& scenario);

/// The measured figure for display: 0 if the design expects 0 and the figure is only a rounding error of the
/// step.
double as_read(const study::ComparisonResult& figure, const study::Scenario& scenario);

}  // namespace sixstep::analysis

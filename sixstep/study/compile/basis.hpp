// SPDX-License-Identifier: Apache-2.0
// What a compiled scenario's parts are designed on, and the parts that have a file of their own.
#pragma once
#include "sixstep/design/loops/field_current.hpp"
#include "sixstep/design/loops/limit_bounds.hpp"
#include "sixstep/study/compile/compile.hpp"

namespace sixstep::study {

/// What the controller is designed on: the motor at hand, or the nominal one of a series.
struct Basis {
  const design::MotorModel& motor;
  plant::Shaft shaft;
  double bus_V;
};

/// What was found wrong with the scenario as an event leaves it, under the event's keys.
base::Problems told_of_event(const Scenario& scenario, const At& at, base::Problems problems);

/// Settling time of the current loop, as designed: the thesis's (chapter 6) where the scenario names none.
double current_settling_s(const Scenario& scenario);

/// Sets drive.extras (drive_extras.hpp) where the scenario asks for any; `drive` has its loops already.
void add_extras(const Scenario& scenario, const Basis& basis, control::DriveConfig<double>& drive);

/// Sets the position loop's profile, where the scenario has one; `tuned` has its loops and limits already.
void add_position_profile(const Scenario& scenario, const Basis& basis, Tuned& tuned);
/// Of a motion that the drive as designed cannot make.
base::Problems check_position_profile(const Scenario& scenario, const Basis& basis,
                                      const control::DriveConfig<double>& drive);

/// What control/limits.hpp has to hold against, at the worst that supply, start and limits allow.
design::LimitSetting limit_setting(const Scenario& scenario, const Basis& basis,
                                   const control::DriveConfig<double>& drive);
/// Of limits that no drive can keep, and currents that its converter does not see.
base::Problems check_limits(const Scenario& scenario, const Basis& basis,
                            const control::DriveConfig<double>& drive);

/// The product drive around `drive`, in SI (protected_drive.hpp).
control::ProtectedConfig<double> product_around(const Scenario& scenario, const Basis& basis,
                                                const control::DriveConfig<double>& drive,
                                                const rig::SensorsConfig& sensors);

struct SensorlessAround {
  control::PulsedDriveConfig<double> config;  ///< SI
  std::vector<design::DerivationStep> steps;  ///< how its numbers came about
};
/// The sensorless drive around `drive`, as design/loops/sensorless_start.hpp makes it, and its pulses, where it starts by them,
/// as pulse_start.hpp does. Problems: a load that it cannot start, a back-EMF that its converter does not see, pulses too strong.
base::Result<SensorlessAround> sensorless_around(const Scenario& scenario, const Basis& basis,
                                                 const control::DriveConfig<double>& drive);

struct FieldAround {
  control::FieldDriveConfig<double> config;    ///< SI
  control::EstimatorConfig<double> estimator;  ///< on where no sensor tells the angle
  std::vector<LoopGains> gains;                ///< of the current loops
  std::vector<design::DerivationStep> steps, estimator_steps;
};
/// The field-oriented drive around `drive`: gains as given, placed or by cancellation (design/loops/field_current.hpp).
/// Problems: a bandwidth that the board's delay does not allow.
base::Result<FieldAround> field_around(const Scenario& scenario, const Basis& basis,
                                       const control::DriveConfig<double>& drive);

/// Adds its estimator, where no sensor tells the angle (design/loops/field_estimate.hpp). `loop_rad_s`: bandwidth of its current loops.
base::Problems add_estimator(const Scenario& scenario, const Basis& basis,
                             const design::FieldMachine& machine, const control::DriveConfig<double>& drive,
                             double loop_rad_s, FieldAround& out);

/// A controller of one's own, as it designs itself by the nominal motor, the board and the loops of `drive`. Problems: what it says
/// that it cannot.
base::Result<rig::OwnConfig> own_designed(const Scenario& scenario, const Basis& basis,
                                          const control::DriveConfig<double>& drive);

/// By how many samples its current across the magnet comes late in the mean (design/loops/speed_laws.hpp).
double field_lag_periods(const Scenario& scenario, const Basis& basis);

/// The speed loop of `tuned`, whose limits and current loop are known, by the law that the scenario asks for
/// (design/loops/speed_laws.hpp); a PI is left as it is. `full_rad_s2`: what a full output accelerates by, `fades_1_s`: what
/// friction takes.
base::Problems add_speed_law(const Scenario& scenario, const Basis& basis, double full_rad_s2,
                             double fades_1_s, Tuned& tuned);

/// N m per A of what the scenario's drive calls the current: the driven pair's, or i_q.
double torque_per_A(const Scenario& scenario, const Basis& basis);

/// A speed that a board learns of by six sectors where the loop stands their delay (design/loops/rotor_sensing.hpp), s; 0
/// without a speed loop.
double speed_window_s(const Scenario& scenario, const Basis& basis,
                      const control::DriveConfig<double>& drive);

}  // namespace sixstep::study

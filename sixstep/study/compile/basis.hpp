// SPDX-License-Identifier: Apache-2.0
// The quantities for which a compiled scenario's parts are designed, and the declarations of the parts that
// have a file of their own.
#pragma once
#include "sixstep/design/loops/field_current.hpp"
#include "sixstep/design/loops/limit_bounds.hpp"
#include "sixstep/study/compile/compile.hpp"

namespace sixstep::study {

/// The controller's design basis: the motor as the drive believes it (believed_motor.hpp), of the scenario or
/// of a series. No number of the plant follows from this basis.
struct Basis {
  const design::MotorModel& motor;
  const design::Sheet& sheet;
  plant::Shaft shaft;
  double bus_V;
};

/// Returns problems that the scenario has after the event `at`, with the event's prefix: "at[0].control...".
base::Problems told_of_event(const Scenario& scenario, const At& at, base::Problems problems);

/// Settling time for which the current loop is designed, s: the scenario's value, else the value of the
/// thesis (chapter 6).
double current_settling_s(const Scenario& scenario);

/// Sets drive.extras (drive_extras.hpp) if the scenario requests any; the loops of `drive` must be set
/// already.
void add_extras(const Scenario& scenario, const Basis& basis, control::DriveConfig<double>& drive);

/// Sets the position loop's profile, if the scenario has one; the loops and limits of `tuned` must be set
/// already.
void add_position_profile(const Scenario& scenario, const Basis& basis, Tuned& tuned);
/// Refuses a profile that the designed drive cannot follow.
base::Problems check_position_profile(const Scenario& scenario, const Basis& basis,
                                      const control::DriveConfig<double>& drive);

/// The worst case of supply, start and limits in which control/limits.hpp must keep the limits.
design::LimitSetting limit_setting(const Scenario& scenario, const Basis& basis,
                                   const control::DriveConfig<double>& drive);
/// Refuses limits that no drive can keep, and currents beyond the converter's range.
base::Problems check_limits(const Scenario& scenario, const Basis& basis,
                            const control::DriveConfig<double>& drive);

/// The product drive around `drive`, in SI (protected_drive.hpp).
control::ProtectedConfig<double> product_around(const Scenario& scenario, const Basis& basis,
                                                const control::DriveConfig<double>& drive,
                                                const rig::SensorsConfig& sensors);

struct SensorlessAround {
  control::PulsedDriveConfig<double> config;  ///< in SI units
  std::vector<design::DerivationStep> steps;  ///< derivation of config's numbers
};
/// The sensorless drive around `drive`, computed by design/loops/sensorless_start.hpp. If the drive starts by
/// pulses, pulse_start.hpp designs them. Problems: a load that the drive cannot start, a back-EMF outside the
/// converter's range, pulses that are too strong.
base::Result<SensorlessAround> sensorless_around(const Scenario& scenario, const Basis& basis,
                                                 const control::DriveConfig<double>& drive);

struct FieldAround {
  control::FieldDriveConfig<double> config;    ///< in SI units
  control::EstimatorConfig<double> estimator;  ///< on if no sensor measures the angle
  std::vector<LoopGains> gains;                ///< gains of the current loops
  std::vector<design::DerivationStep> steps, estimator_steps;
};
/// The field-oriented drive around `drive`. Its gains are given, placed, or designed by cancellation
/// (design/loops/field_current.hpp). Problems: a bandwidth that the board's delay does not allow.
base::Result<FieldAround> field_around(const Scenario& scenario, const Basis& basis,
                                       const control::DriveConfig<double>& drive);

/// Adds the estimator if no sensor measures the angle (design/loops/field_estimate.hpp). `loop_rad_s`:
/// bandwidth of the current loops.
base::Problems add_estimator(const Scenario& scenario, const Basis& basis,
                             const design::FieldMachine& machine, const control::DriveConfig<double>& drive,
                             double loop_rad_s, FieldAround& out);

/// Calls the design function of the user's controller with the nominal motor, the board and the loops of
/// `drive`. Problems: the controller's design function returned an error.
base::Result<rig::OwnConfig> own_designed(const Scenario& scenario, const Basis& basis,
                                          const control::DriveConfig<double>& drive);

/// Mean delay of the q-axis current, in samples (design/loops/speed_laws.hpp).
double field_lag_periods(const Scenario& scenario, const Basis& basis);

/// Designs the speed loop of `tuned`, whose limits and current loop are already set, by the scenario's law
/// (design/loops/speed_laws.hpp); a PI stays unchanged. `full_rad_s2`: acceleration at full output.
/// `fades_1_s`: decay rate of the speed by friction.
base::Problems add_speed_law(const Scenario& scenario, const Basis& basis, double full_rad_s2,
                             double fades_1_s, Tuned& tuned);

/// Torque constant in N m/A for the current that the scenario's drive controls: of the driven pair, or i_q.
double torque_per_A(const Scenario& scenario, const Basis& basis);

/// Time in s within which six Hall edges must occur to be averaged. If they take longer, the board measures
/// the speed over one edge (design/loops/rotor_sensing.hpp). 0 without a speed loop.
double speed_window_s(const Scenario& scenario, const Basis& basis,
                      const control::DriveConfig<double>& drive);

}  // namespace sixstep::study

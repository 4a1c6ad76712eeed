// SPDX-License-Identifier: Apache-2.0
// compile() turns a scenario into the parts of a run: plant parameters, controller configuration, board,
// timeline, gains with their origin.
#pragma once
#include "sixstep/base/result.hpp"
#include "sixstep/control/commissioning/pulse_start.hpp"
#include "sixstep/control/field/sensorless_field_drive.hpp"
#include "sixstep/control/protected_drive.hpp"
#include "sixstep/plant/general/machine.hpp"
#include "sixstep/rig/own_drive.hpp"
#include "sixstep/rig/rig.hpp"
#include "sixstep/study/measure/outcome.hpp"
#include "sixstep/study/scenario/reference_waveform.hpp"
#include "sixstep/study/scenario/scenario.hpp"

namespace sixstep::study {

/// The controller's configuration after one event.
struct Tuned {
  control::DriveConfig<double> drive;
  std::vector<LoopGains> gains;
  std::optional<control::ProtectedConfig<double>> product;       ///< the product drive around `drive`, if the
                                                                 ///< chip runs it
  std::optional<control::PulsedDriveConfig<double>> sensorless;  ///< sensorless drive around `drive`
  std::optional<control::FieldDriveConfig<double>> field;        ///< field-oriented drive around `drive`
  rig::OwnConfig own;                          ///< configuration of a user's controller, instead of `drive`
  control::EstimatorConfig<double> estimator;  ///< estimator of a field-oriented drive without a rotor sensor
};

/// Parameters of the general kernel; present if the scenario needs a feature that the lean kernel lacks
/// (plant/general/).
struct GeneralPlant {
  plant::general::Machine machine;
  plant::general::Shaft shaft;
  plant::general::Devices devices;
  plant::general::Supply supply;
  plant::general::Start start;
  plant::general::HeatGiven heat;
};

/// The motor as the drive believes it, and the shaft of this motor and its load together.
struct BelievedMotor {
  design::MotorModel motor;
  plant::Shaft shaft;
};

struct Compiled {
  design::MotorModel motor;  ///< the simulated motor
  plant::Shaft shaft;        ///< shaft of motor and load together
  BelievedMotor believed;    ///< source of all numbers of the controller
  plant::Devices devices;
  plant::Supply supply;
  plant::Start start;
  rig::BoardConfig board;
  rig::Wiring wiring;      ///< wiring at the start; straight with the lean kernel
  rig::ProbeGiven probes;  ///< positions of the Hall edges; with the lean kernel they are the sector edges
  rig::Timeline timeline;
  control::DriveConfig<double> drive;
  std::optional<control::ProtectedConfig<double>> product;       ///< the product drive around `drive`, if the
                                                                 ///< chip runs it
  std::optional<control::PulsedDriveConfig<double>> sensorless;  ///< sensorless drive around `drive`
  std::optional<control::FieldDriveConfig<double>> field;        ///< field-oriented drive around `drive`
  rig::OwnConfig own;                          ///< configuration of a user's controller, instead of `drive`
  control::EstimatorConfig<double> estimator;  ///< estimator of a field-oriented drive without a rotor sensor
  std::vector<LoopGains> gains;
  std::vector<design::DerivationStep> sensorless_steps;  ///< derivation of the sensorless drive's numbers
  std::vector<design::DerivationStep> field_steps;       ///< derivation of the field-oriented drive's numbers
  std::vector<design::DerivationStep> estimator_steps;   ///< derivation of the field-oriented drive's
                                                         ///< estimator
  std::vector<Tuned> later;             ///< configurations for the timeline's retune actions, by their number
  double setpoint_range = 1.0;          ///< setpoint at the ends of a chip's potentiometer, with both signs
                                        ///< (setpoint_range.hpp)
  std::optional<GeneralPlant> general;  ///< replaces motor, shaft, devices, supply and start
  sim::Instant end;
};

/// Duty above which a shunt in the DC link shows the current: the sample instant lies in the on-time, and the
/// amplifier has settled. With complementary chopping the on-time begins later by one dead time.
double least_visible_duty(const Scenario& scenario);
/// The same duty, increased by the delay of the reading after the pulse's start and by the modulator's
/// shortest pulse.
double least_shown_duty(const Scenario& scenario);
/// Current in A that flows at the duty least_shown_duty() with the rotor at rest, through two phases (2 R)
/// and the bridge's conducting devices. The shunt does not show smaller currents. 0 if this duty drives no
/// positive current, as with hard chopping below one half.
double unseen_at_rest_A(const Scenario& scenario, double R_ohm);

/// Turns a scenario into the parts of a run. Requires that check() found nothing.
base::Result<Compiled> compile(const Scenario& scenario);

/// A loop's gains per sample, as its keys give them; empty if the pole placement designs them. Problems:
/// gains given in more than one way, or incompletely.
struct GivenGains {
  std::optional<design::PiGains> gains;
  std::string origin;
  base::Problems problems;
};
template <class Loop>
GivenGains given_gains(const Loop& loop, double period_s, const std::string& where);

}  // namespace sixstep::study

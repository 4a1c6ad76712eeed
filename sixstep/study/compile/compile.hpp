// SPDX-License-Identifier: Apache-2.0
// compile() turns a scenario into what a run is made of: plant parameters, controller configuration, board,
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

/// The controller as one event leaves it.
struct Tuned {
  control::DriveConfig<double> drive;
  std::vector<LoopGains> gains;
  std::optional<control::ProtectedConfig<double>> product;       ///< around the drive, where the chip runs it
  std::optional<control::PulsedDriveConfig<double>> sensorless;  ///< alike
  std::optional<control::FieldDriveConfig<double>> field;        ///< alike
  rig::OwnConfig own;                                            ///< in its place, where it is one's own
  control::EstimatorConfig<double> estimator;  ///< of the field-oriented drive without a rotor sensor
};

/// What the general kernel is given, where the scenario asks for what the lean one lacks (plant/general/).
struct GeneralPlant {
  plant::general::Machine machine;
  plant::general::Shaft shaft;
  plant::general::Devices devices;
  plant::general::Supply supply;
  plant::general::Start start;
  plant::general::HeatGiven heat;
};

struct Compiled {
  design::MotorModel motor;
  plant::Shaft shaft;  ///< the motor's with the load's share added
  plant::Devices devices;
  plant::Supply supply;
  plant::Start start;
  rig::BoardConfig board;
  rig::Wiring wiring;      ///< at the start; straight where the lean kernel runs
  rig::ProbeGiven probes;  ///< as the sectors are where the lean kernel runs
  rig::Timeline timeline;
  control::DriveConfig<double> drive;
  std::optional<control::ProtectedConfig<double>> product;       ///< around the drive, where the chip runs it
  std::optional<control::PulsedDriveConfig<double>> sensorless;  ///< alike
  std::optional<control::FieldDriveConfig<double>> field;        ///< alike
  rig::OwnConfig own;                                            ///< in its place, where it is one's own
  control::EstimatorConfig<double> estimator;  ///< of the field-oriented drive without a rotor sensor
  std::vector<LoopGains> gains;
  std::vector<design::DerivationStep> sensorless_steps;  ///< of the sensorless drive's numbers
  std::vector<design::DerivationStep> field_steps;       ///< of the field-oriented drive's
  std::vector<design::DerivationStep> estimator_steps;   ///< of its estimator's
  std::vector<Tuned> later;                              ///< what the timeline's retune actions name
  double setpoint_range = 1.0;  ///< that a chip's potentiometer has to reach, either way (setpoint_range.hpp)
  std::optional<GeneralPlant> general;  ///< runs in the place of motor, shaft, devices and supply
  sim::Instant end;
};

/// Of a shunt in the DC link: the duty above which the middle of the period lies in the on-time and the amplifier has settled. With
/// complementary chopping the on-time begins a dead time later.
double least_visible_duty(const Scenario& scenario);
/// The same with what delays the reading behind the pulse, and with the shortest pulse that the modulator makes.
double least_shown_duty(const Scenario& scenario);
/// The current that flows at that duty with the rotor at rest, A, through a pair of phases of 2 R and what conducts of the bridge: what is
/// below it is not seen. 0 where that duty drives no current forwards, as with hard chopping below one half.
double unseen_at_rest_A(const Scenario& scenario, double R_ohm);

/// Assumes that check() found nothing.
base::Result<Compiled> compile(const Scenario& scenario);

/// The gains as a loop's keys give them, per sample; empty where they are left to the pole placement. Problems: given in more
/// than one way, or half.
struct GivenGains {
  std::optional<design::PiGains> gains;
  std::string origin;
  base::Problems problems;
};
template <class Loop>
GivenGains given_gains(const Loop& loop, double period_s, const std::string& where);

}  // namespace sixstep::study

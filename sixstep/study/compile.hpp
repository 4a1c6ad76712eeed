// SPDX-License-Identifier: Apache-2.0
// Scenario -> what a run is made of: plant parameters, controller configuration, board, timeline, gains with
// their origin.
#pragma once
#include "sixstep/base/result.hpp"
#include "sixstep/control/drive.hpp"
#include "sixstep/rig/rig.hpp"
#include "sixstep/study/outcome.hpp"
#include "sixstep/study/scenario.hpp"

namespace sixstep::study {

struct Compiled {
  design::MotorModel motor;
  plant::Shaft shaft;  ///< the motor's with the load's share added
  plant::Devices devices;
  plant::Supply supply;
  plant::Start start;
  rig::BoardConfig board;
  rig::Timeline timeline;
  control::DriveConfig<double> drive;
  std::vector<LoopGains> gains;
  sim::Instant end;
};

/// Assumes that check() found nothing.
base::Result<Compiled> compile(const Scenario& scenario);

/// The reference's values over time: {instant, value}, first at 0.
struct Level {
  double at_s = 0.0;
  double value = 0.0;
};
std::vector<Level> reference_levels(const Reference& reference, double duration_s);

/// Gains given in more than one way, or half: Problems; else whether any were given at all.
struct GivenGains {
  std::optional<design::PiGains> gains;
  std::string origin;
  base::Problems problems;
};
template <class Loop>
GivenGains given_gains(const Loop& loop, const std::string& where);

/// The same controller in another arithmetic.
template <class Scalar>
control::DriveConfig<Scalar> in_arithmetic(const control::DriveConfig<double>& c) {
  const auto s = [](double v) { return static_cast<Scalar>(v); };
  const control::LimitsConfig<double>& l = c.extras.limits;  // what compile() sets of the extras
  return {.mode = c.mode,
          .chopping = c.chopping,
          .current_control = c.current_control,
          .current = {s(c.current.d1), s(c.current.d0), s(c.current.limit)},
          .hysteresis = {s(c.hysteresis.band_A), c.hysteresis.watch},
          .nominal_bus_V = s(c.nominal_bus_V),
          .speed = {s(c.speed.d1), s(c.speed.d0), s(c.speed.limit)},
          .current_at_full_torque_A = s(c.current_at_full_torque_A),
          .current_limit_A = s(c.current_limit_A),
          .position_gain = s(c.position_gain),
          .speed_limit_rad_s = s(c.speed_limit_rad_s),
          .extras = {.on = c.extras.on,
                     .limits_current = c.extras.limits_current,
                     .limits = {.current_A = s(l.current_A),
                                .limits_regeneration = l.limits_regeneration,
                                .bus_V = s(l.bus_V),
                                .A_per_V = s(l.A_per_V)},
                     .torque_fraction_per_A = s(c.extras.torque_fraction_per_A)}};
}

}  // namespace sixstep::study

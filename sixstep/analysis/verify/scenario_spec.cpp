// SPDX-License-Identifier: Apache-2.0
#include "sixstep/analysis/verify/scenario_spec.hpp"

#include <algorithm>
#include <cmath>

#include "sixstep/study/scenario/reference_waveform.hpp"

namespace sixstep::analysis {
namespace {

using control::Mode;

/// The least speed but standstill that a reference asks for; empty where it is no speed.
std::optional<double> lowest_speed(const study::Scenario& s) {
  if (s.control.mode != Mode::speed) return std::nullopt;
  std::optional<double> least;
  for (const study::Level& level : study::reference_levels(s))
    if (level.value != 0.0) least = std::min(std::fabs(level.value), least.value_or(std::fabs(level.value)));
  return least;
}

}  // namespace

design::DesignSpec spec_of(const study::Scenario& s) {
  design::DesignSpec w;
  const bool loops =
      s.control.mode == Mode::current || s.control.mode == Mode::speed || s.control.mode == Mode::position;
  if (loops) w.mode = s.control.mode;
  w.settle_s = w.mode == Mode::current ? s.control.current.settle_s : s.control.speed.settle_s;
  if (w.mode != Mode::current) w.current_settle_s = s.control.current.settle_s;
  const std::optional<double>& damping =
      w.mode == Mode::current ? s.control.current.damping : s.control.speed.damping;
  w.damping = damping.value_or(w.damping);
  w.period_s = s.pwm.period_s;
  w.voltage_V = s.supply.voltage_V;
  w.torque_limit_Nm = s.control.speed.torque_limit_Nm;
  w.load_inertia_kg_m2 = s.load.inertia_kg_m2;
  w.delay_periods = s.pwm.delay_periods;
  w.chopping = s.pwm.chopping;
  // The product drive has no other sensor than its Hall probes.
  w.rotor.hall =
      s.sensors.rotor == study::RotorSensing::hall || s.control.drive == study::FirmwareKind::product;
  w.rotor.edges = s.sensors.speed_edges;
  w.lowest_speed_rad_s = lowest_speed(s);
  return w;
}

}  // namespace sixstep::analysis

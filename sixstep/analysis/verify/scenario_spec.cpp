// SPDX-License-Identifier: Apache-2.0
#include "sixstep/analysis/verify/scenario_spec.hpp"

#include <algorithm>
#include <cmath>

#include "sixstep/analysis/verify/board.hpp"
#include "sixstep/base/angle.hpp"
#include "sixstep/design/loops/spec_check.hpp"
#include "sixstep/design/loops/tracking_loop.hpp"
#include "sixstep/study/compile/shaft_sensor.hpp"
#include "sixstep/study/scenario/believed_motor.hpp"
#include "sixstep/study/scenario/choices.hpp"
#include "sixstep/study/scenario/reference_waveform.hpp"

namespace sixstep::analysis {
namespace {

using control::Mode;

/// The lowest speed of a reference except standstill, rad/s; empty if the reference is no speed.
std::optional<double> lowest_speed(const study::Scenario& s) {
  if (s.control.mode != Mode::speed) return std::nullopt;
  std::optional<double> least;
  for (const study::Level& level : study::reference_levels(s))
    if (level.value != 0.0) least = std::min(std::fabs(level.value), least.value_or(std::fabs(level.value)));
  return least;
}

/// Sets the loop that tracks a resolver, from bandwidth and damping.
void take_resolver(const study::Scenario& s, design::ShaftSensing& to) {
  const study::Resolver& r = s.sensors.resolver;
  const bool sampled = r.reading == rig::ResolverReading::sampled;
  to.pole_pairs = r.pole_pairs;
  to.damping = r.damping;
  to.step_s = study::tracking_period_s(s);
  if (const auto loop = design::tracking_loop({2 * base::pi * r.bandwidth_Hz, r.damping, to.step_s}))
    to.natural_rad_s = loop->natural_rad_s;
  // Two samples, a step apart, give one reading. It is half a step old, and its noise power is half of the
  // samples' noise power.
  to.latency_s = sampled ? to.step_s / 2 : r.latency_s;
  to.noise_rad = r.noise_V / r.amplitude_V / (sampled ? std::sqrt(2.0) : 1.0);
}

design::ShaftSensing shaft_sensing(const study::Scenario& s) {
  const study::Sensors& x = s.sensors;
  design::ShaftSensing to{.gear = x.shaft == study::SensorShaft::load ? s.load.gear : 1.0,
                          .period_s = s.pwm.period_s};
  switch (x.rotor) {
    case study::RotorSensing::ideal:
    case study::RotorSensing::hall:
      break;
    case study::RotorSensing::encoder:
      to.kind = design::ShaftSensorKind::encoder;
      to.lines = x.encoder.lines;
      if (const rig::ShaftSensorConfig given = study::shaft_sensor_config(s); given.linear) {
        to.linear = true;
        to.gear = given.gear;
        to.lines = given.encoder.lines;
      }
      to.capture_Hz = x.capture_Hz;
      to.timeout_s = x.timeout_s;
      break;
    case study::RotorSensing::absolute:
      to.kind = design::ShaftSensorKind::absolute;
      to.bits = x.absolute.bits;
      to.samples = x.absolute.speed_samples;
      to.latency_s = x.absolute.latency_s;
      break;
    case study::RotorSensing::resolver:
      to.kind = design::ShaftSensorKind::resolver;
      take_resolver(s, to);
      break;
  }
  return to;
}

/// Largest error of the total length of k successive sectors, rad.
double stray_of(const std::vector<double>& edges_deg, std::size_t k) {
  double most = 0.0;
  for (std::size_t n = 0; n < edges_deg.size(); ++n)
    most = std::max(most, std::fabs(edges_deg[(n + k) % edges_deg.size()] - edges_deg[n]));
  return most * base::pi / 180;
}

}  // namespace

base::Problems passed_over(const study::Scenario& s) {
  base::Problems found;
  const auto tell = [&found](const char* key, std::string_view word) {
    found.push_back({key, '"' + std::string(word) + '"',
                     "is derived in the report of a run; a design derives PI loops only",
                     "run the scenario and read its report, or set this key to \"pi\""});
  };
  if (s.control.current.type == study::CurrentLoopType::deadbeat)
    tell("control.current.type", base::word(study::current_loop_choices, s.control.current.type));
  if (s.control.speed.law != study::SpeedLaw::pi)
    tell("control.speed.law", base::word(study::speed_law_choices, s.control.speed.law));
  return found;
}

design::RotorSensing rotor_sensing_of(const study::Scenario& s) {
  design::RotorSensing to;
  // The product drive has no sensor except Hall probes. In the sensorless drive crossings replace Hall edges.
  const study::FirmwareKind drive = s.control.drive;
  to.hall = s.sensors.rotor == study::RotorSensing::hall || drive == study::FirmwareKind::product ||
            drive == study::FirmwareKind::sensorless;
  to.edges = s.sensors.speed_edges;
  // If the angles of the edges are learned, their errors need not cancel over a whole turn.
  if (s.sensors.hall_angle == rig::HallAngleFrom::learned_edges) to.edges = std::max(to.edges, 1);
  if (!to.hall) to.shaft = shaft_sensing(s);
  if (s.sensors.rotor != study::RotorSensing::hall) return to;
  to.late_s = s.sensors.hall_delay_s;
  to.timeout_s = s.sensors.timeout_s;
  to.capture_Hz = s.sensors.capture_Hz;
  if (s.sensors.hall_angle != rig::HallAngleFrom::learned_edges)
    to.stray_rad = stray_of(s.sensors.hall_edges_deg, static_cast<std::size_t>(std::max(to.edges, 1)));
  return to;
}

design::DesignSpec spec_of(const study::Scenario& s, std::optional<Mode> mode) {
  design::DesignSpec w;
  const bool loops =
      s.control.mode == Mode::current || s.control.mode == Mode::speed || s.control.mode == Mode::position;
  if (loops) w.mode = s.control.mode;
  if (mode) w.mode = *mode;
  w.settle_s = w.mode == Mode::current ? s.control.current.settle_s : s.control.speed.settle_s;
  if (w.mode != Mode::current) w.current_settle_s = s.control.current.settle_s;
  const std::optional<double>& damping =
      w.mode == Mode::current ? s.control.current.damping : s.control.speed.damping;
  w.damping = damping.value_or(w.damping);
  if (w.mode != Mode::current) {
    w.current_damping = s.control.current.damping;
    w.current_limit_A = s.control.current.limit_A;
  }
  w.period_s = s.pwm.period_s;
  w.voltage_V = s.supply.voltage_V;
  w.torque_limit_Nm = s.control.speed.torque_limit_Nm;
  w.load_inertia_kg_m2 =
      s.load.inertia_kg_m2 / (s.load.gear * s.load.gear);  // the loops refer to the motor's shaft
  w.delay_periods = s.pwm.delay_periods;
  w.sampled_in_middle = s.pwm.sample == study::SampleAt::middle;
  // Smooth chopping counts as complementary: while current flows, both apply the same voltage to the pair.
  w.chopping = s.control.smooth_chopping.on ? control::Chopping::complementary : s.pwm.chopping;
  w.rotor = rotor_sensing_of(s);
  w.lowest_speed_rad_s = lowest_speed(s);
  const base::Result<design::MotorModel> motor = study::believed_motor(s);
  if (!motor) return w;
  if (const std::optional<double> most = most_current_A(s, motor->K_t_Nm_A); most && w.mode != Mode::current)
    w.current_limit_A = std::min(*most, w.current_limit_A.value_or(*most));
  if (!w.lowest_speed_rad_s) return w;
  // With a reference near the largest speed of the bus or of the board, no step down to this speed would be
  // possible.
  if (const double most = most_lowest_speed_rad_s(*motor, w); most > 0.0)
    w.lowest_speed_rad_s = std::min(*w.lowest_speed_rad_s, most);
  if (const std::optional<double> most = most_speed_rad_s(s))
    w.lowest_speed_rad_s = std::min(*w.lowest_speed_rad_s, 0.8 * *most);
  return w;
}

}  // namespace sixstep::analysis

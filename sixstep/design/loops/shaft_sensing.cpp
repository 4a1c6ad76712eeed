// SPDX-License-Identifier: Apache-2.0
#include "sixstep/design/loops/shaft_sensing.hpp"

#include <cmath>

#include "sixstep/base/angle.hpp"
#include "sixstep/base/written.hpp"

namespace sixstep::design {
namespace {

/// Angle of one count of the sensor, rad of the motor's shaft.
double count_rad(const ShaftSensing& s) {
  const double counts = s.kind == ShaftSensorKind::encoder ? 4.0 * s.lines : std::ldexp(1.0, s.bits);
  return s.gear * 2 * base::pi / counts;
}

/// Time from one count to the next, s.
double count_s(const ShaftSensing& s, double speed_rad_s) { return count_rad(s) / std::fabs(speed_rad_s); }

void add_encoder(const ShaftSensing& s, double speed, std::vector<DerivationStep>& steps) {
  const ShaftSpeedAge age = speed_age(s, speed);
  steps.push_back({"c", "(2 pi/4N)/w_low, a count at that speed", age.hold_s, "s"});
  steps.push_back({"T", "max(T_s, c), averaging time of a speed", age.mean_s, "s"});
  steps.push_back({"dw", "w_low/(f T), a tick of the timer", speed_jitter_rad_s(s, speed), "rad/s"});
  steps.push_back(
      {"w_min", "(2 pi/4N)/timeout_s, slowest speed that does not read as 0", lowest_told_rad_s(s), "rad/s"});
}

void add_absolute(const ShaftSensing& s, double speed, std::vector<DerivationStep>& steps) {
  steps.push_back({"T", "k T_s, averaging time of a speed", speed_age(s, speed).mean_s, "s"});
  steps.push_back({"t_l", "age of the latched code at the sample", s.latency_s, "s"});
  steps.push_back({"dw", "(2 pi/2^n)/(k T_s), a count", speed_jitter_rad_s(s, speed), "rad/s"});
  steps.push_back({"w_min", "as dw: slower speeds sometimes read as 0", lowest_told_rad_s(s), "rad/s"});
}

void add_resolver(const ShaftSensing& s, double speed, std::vector<DerivationStep>& steps) {
  steps.push_back({"w_n", "natural frequency of the tracking loop", s.natural_rad_s, "rad/s"});
  steps.push_back({"2 D/w_n", "delay of its speed", 2 * s.damping / s.natural_rad_s, "s"});
  steps.push_back({"t_l", "delay of its angle", s.latency_s, "s"});
  steps.push_back({"dw", "s sqrt(T_l w_n^3/(4 D)), root mean square", speed_jitter_rad_s(s, speed), "rad/s"});
}

}  // namespace

std::string sensor_words(const ShaftSensing& s) {
  if (s.linear) return "encoder, pitch " + base::rounded(s.gear * 2e3 * base::pi / s.lines, 4) + " mm";
  const std::string side = s.gear == 1.0 ? "" : ", on the load's side";
  switch (s.kind) {
    case ShaftSensorKind::none:
      return "ideal";
    case ShaftSensorKind::encoder:
      return "encoder, " + std::to_string(s.lines) + " lines" + side;
    case ShaftSensorKind::absolute:
      return "absolute encoder, " + std::to_string(s.bits) + " bits" + side;
    case ShaftSensorKind::resolver:
      return "resolver, loop of " + base::rounded(s.natural_rad_s, 3) + " rad/s" + side;
  }
  return "";
}

ShaftSpeedAge speed_age(const ShaftSensing& s, double speed_rad_s) {
  switch (s.kind) {
    case ShaftSensorKind::none:
      break;
    case ShaftSensorKind::encoder: {
      const double c = count_s(s, speed_rad_s);
      return {std::fmax(s.period_s, c), c, 0.0};
    }
    case ShaftSensorKind::absolute:
      return {s.samples * s.period_s, 0.0, s.latency_s};
    case ShaftSensorKind::resolver:
      return {0.0, 0.0, 2 * s.damping / s.natural_rad_s + s.latency_s};
  }
  return {};
}

double speed_jitter_rad_s(const ShaftSensing& s, double speed_rad_s) {
  switch (s.kind) {
    case ShaftSensorKind::none:
      break;
    case ShaftSensorKind::encoder:
      return std::fabs(speed_rad_s) / (s.capture_Hz * speed_age(s, speed_rad_s).mean_s);
    case ShaftSensorKind::absolute:
      return count_rad(s) / (s.samples * s.period_s);
    case ShaftSensorKind::resolver: {
      const double w_n = s.natural_rad_s;
      return s.gear * s.noise_rad / s.pole_pairs * std::sqrt(s.step_s * w_n * w_n * w_n / (4 * s.damping));
    }
  }
  return 0.0;
}

double lowest_told_rad_s(const ShaftSensing& s) {
  if (s.kind == ShaftSensorKind::encoder) return count_rad(s) / s.timeout_s;
  return s.kind == ShaftSensorKind::absolute ? speed_jitter_rad_s(s, 0.0) : 0.0;
}

std::vector<DerivationStep> shaft_sensing_steps(const ShaftSensing& s, double speed_rad_s) {
  std::vector<DerivationStep> steps;
  if (s.kind == ShaftSensorKind::encoder) add_encoder(s, speed_rad_s, steps);
  if (s.kind == ShaftSensorKind::absolute) add_absolute(s, speed_rad_s, steps);
  if (s.kind == ShaftSensorKind::resolver) add_resolver(s, speed_rad_s, steps);
  return steps;
}

}  // namespace sixstep::design

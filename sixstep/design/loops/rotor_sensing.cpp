// SPDX-License-Identifier: Apache-2.0
#include "sixstep/design/loops/rotor_sensing.hpp"

#include <algorithm>
#include <cmath>

#include "sixstep/base/angle.hpp"
#include "sixstep/base/elementary.hpp"

namespace sixstep::design {
namespace {

double sinc(double x) { return std::fabs(x) < 1e-4 ? 1.0 - x * x / 6.0 : base::sin(x) / x; }

double sector_s(double pole_pairs, double speed_rad_s) { return base::pi / 3 / (pole_pairs * speed_rad_s); }

constexpr int one_turn = 6;  // sectors of an electrical turn

}  // namespace

std::string edges_words(const RotorSensing& sensing) {
  if (sensing.shaft.kind != ShaftSensorKind::none) return sensor_words(sensing.shaft);
  if (sensing.edges == 0) return "Hall, 6 edges or 1";
  return "Hall, " + std::to_string(sensing.edges) + (sensing.edges == 1 ? " edge" : " edges");
}

double hall_window_s(double crossover_rad_s) {
  if (!(crossover_rad_s > 0.0)) return 0.0;
  return six_edges_phase_rad / crossover_rad_s * 2 * one_turn / (one_turn + 1);
}

double speed_crossover_rad_s(double d1, double full_acceleration_rad_s2) {
  return std::fabs(d1) * full_acceleration_rad_s2;
}

Complex SpeedLag::at(double v_rad_s) const {
  const double size = sinc(v_rad_s * mean_s / 2) * sinc(v_rad_s * hold_s / 2), turn = v_rad_s * delay_s();
  return {size * base::cos(turn), -size * base::sin(turn)};
}

SpeedLag speed_lag(const RotorSensing& sensing, double pole_pairs, double speed_rad_s,
                   double crossover_rad_s) {
  if (sensing.shaft.kind != ShaftSensorKind::none) {
    const ShaftSpeedAge age = speed_age(sensing.shaft, speed_rad_s);
    return {age.mean_s, age.hold_s, age.late_s};
  }
  if (!sensing.hall) return {};
  const double T = sector_s(pole_pairs, speed_rad_s);
  if (sensing.edges > 0) return {sensing.edges * T, T, sensing.late_s};
  const double window = hall_window_s(crossover_rad_s);
  const SpeedLag one{T, T, sensing.late_s};
  // Six edges are used above the speed at which they fit into the window; at higher speeds they follow
  // faster.
  const double at_most = std::fmin(window, one_turn * T);
  const SpeedLag six{at_most, at_most / one_turn, sensing.late_s};
  return six.delay_s() > one.delay_s() || one_turn * T <= window ? six : one;
}

double speed_step_rad_s(const RotorSensing& sensing, double pole_pairs, double speed_rad_s,
                        double crossover_rad_s) {
  if (sensing.shaft.kind != ShaftSensorKind::none) return speed_jitter_rad_s(sensing.shaft, speed_rad_s);
  if (!sensing.hall || !(speed_rad_s > 0.0)) return 0.0;
  const double T = sector_s(pole_pairs, speed_rad_s);
  const bool turn = sensing.edges == 0 && one_turn * T <= hall_window_s(crossover_rad_s);
  const double edges = turn ? one_turn : std::max(sensing.edges, 1);
  const double tick = sensing.capture_Hz > 0.0 ? 1.0 / (sensing.capture_Hz * edges * T) : 0.0;
  // Over a whole turn the errors of the probes' positions cancel.
  const double stray = turn ? 0.0 : sensing.stray_rad / (edges * base::pi / 3);
  return speed_rad_s * (tick + stray);
}

namespace {

/// Adds the crossover of the loop with its proportional gain only, from which the chip's window is computed.
/// With its integral and lags the loop crosses over at another frequency.
void add_crossover(double crossover_rad_s, std::vector<DerivationStep>& steps) {
  if (!(crossover_rad_s > 0.0)) return;
  steps.push_back({"w_c", "d1 T_max/J, crossover of the speed loop with d1 only", crossover_rad_s, "rad/s"});
}

/// True if at this speed the speed is measured over one edge: the errors of the probes' positions then do not
/// cancel.
bool one_edge_at(const RotorSensing& sensing, double pole_pairs, double speed_rad_s, double crossover_rad_s) {
  const double turn_s = one_turn * sector_s(pole_pairs, speed_rad_s);
  return sensing.edges == 1 || (sensing.edges == 0 && turn_s > hall_window_s(crossover_rad_s));
}

/// Adds the delay of a sensor and the loss of phase by it to a derivation.
void add_cost(const SpeedLag& lag, const char* formula, double crossover_rad_s,
              std::vector<DerivationStep>& steps) {
  steps.push_back({"delay", formula, lag.delay_s(), "s"});
  steps.push_back({"phase", "w_c times the delay, phase loss from the sensor",
                   crossover_rad_s * lag.delay_s() * 180 / base::pi, "deg"});
}

}  // namespace

std::vector<DerivationStep> lag_steps(const RotorSensing& sensing, double pole_pairs, double speed_rad_s,
                                      double crossover_rad_s) {
  if (!sensing.lags()) return {};
  const SpeedLag lag = speed_lag(sensing, pole_pairs, speed_rad_s, crossover_rad_s);
  if (sensing.shaft.kind != ShaftSensorKind::none) {
    std::vector<DerivationStep> steps{{"w_low", "lowest speed of the design", speed_rad_s, "rad/s"}};
    for (const DerivationStep& step : shaft_sensing_steps(sensing.shaft, speed_rad_s)) steps.push_back(step);
    add_crossover(crossover_rad_s, steps);
    add_cost(lag, "half of the averaging time and of the hold time, plus the sensor's latency",
             crossover_rad_s, steps);
    return steps;
  }
  std::vector<DerivationStep> steps{
      {"w_low", "lowest speed of the design", speed_rad_s, "rad/s"},
      {"T", "(pi/3)/(p w_low), a sector at that speed", sector_s(pole_pairs, speed_rad_s), "s"}};
  add_crossover(crossover_rad_s, steps);
  if (sensing.edges == 0)
    steps.push_back(
        {"T_6",
         "(pi/8)(12/7)/w_c: if six edges take at most this time, they cost at most pi/8 of phase, and the speed is averaged over six edges; else over one edge",
         hall_window_s(crossover_rad_s), "s"});
  else
    steps.push_back(
        {"k", "number of edges over which the speed is averaged", static_cast<double>(sensing.edges), ""});
  if (sensing.stray_rad > 0.0)
    steps.push_back({"dw", "w_low s/(k pi/3), s: error of k sectors from misplaced probes",
                     speed_rad_s * sensing.stray_rad / (std::max(sensing.edges, 1) * base::pi / 3), "rad/s"});
  else if (one_edge_at(sensing, pole_pairs, speed_rad_s, crossover_rad_s))
    steps.push_back(
        {"dw_3",
         "w_low 6/60, the error if neighbouring edges are misplaced by 3 deg to opposite sides; this design assumes none",
         speed_rad_s * 6 / 60, "rad/s"});
  if (sensing.timeout_s > 0.0)
    steps.push_back({"w_min", "(pi/3)/(p timeout_s), slowest speed that does not read as 0",
                     sector_s(pole_pairs, 1.0) / sensing.timeout_s, "rad/s"});
  add_cost(lag,
           sensing.late_s > 0.0 ? "(k + 1)/2 sectors, the most from w_low up, plus the delay of the lines"
                                : "(k + 1)/2 sectors, the most from w_low up",
           crossover_rad_s, steps);
  return steps;
}

}  // namespace sixstep::design

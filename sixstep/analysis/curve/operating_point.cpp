// SPDX-License-Identifier: Apache-2.0
#include "sixstep/analysis/curve/operating_point.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <deque>
#include <vector>

#include "sixstep/analysis/curve/full_on.hpp"
#include "sixstep/analysis/curve/open_loop.hpp"
#include "sixstep/analysis/curve/shape_means.hpp"
#include "sixstep/analysis/curve/sums_recorder.hpp"
#include "sixstep/base/elementary.hpp"
#include "sixstep/base/written.hpp"

namespace sixstep::analysis {
namespace {

using plant::PerLeg;

/// Slowest decay rate of the currents, 1/s (operating_point.hpp).
double forgetting_rate(const Bench& b) { return b.motor.machine.R_ohm / b.motor.machine.L_H; }

double sector_seconds(const Bench& b, double speed) {
  return base::sector_rad / (b.motor.machine.pole_pairs * std::fabs(speed));
}

/// The Problem of a run that stopped before its end or its target edge.
base::Problem ended_early(double speed, sim::Stop stop) {
  if (stop == sim::Stop::end || stop == sim::Stop::observer) return interrupted_work();
  return {
      "speed " + base::written(speed) + " rad/s", "",
      stop == sim::Stop::unsettled ? "no consistent conduction mode was found"
                                   : "switching events repeat without end at one instant",
      "this is a defect of sixstep: report this message, with the motor file, in the issues of the repository"};
}

/// Electrical mean values of the orbit; take_to_shaft() subtracts the friction.
OperatingPoint point_of(const Bench& b, double speed, const Sums& sums) {
  const double T = sums.seconds;
  OperatingPoint p;
  p.speed_rad_s = speed;
  p.torque_Nm = sums.torque / T;
  p.ripple_Nm = sums.torque_high - sums.torque_low;
  p.ripple_rms_Nm = std::sqrt(std::max(0.0, sums.torque_square / T - p.torque_Nm * p.torque_Nm));
  p.supplied_W = sums.supplied / T;
  p.bus_current_A = p.supplied_W / b.voltage_V;
  p.copper_W = sums.copper / T;
  p.devices_W = sums.devices / T;
  p.winding_current_A = sums.winding / T;
  p.motor_current_A = sums.motor_size / T;
  // on average, the three phases carry equal shares
  p.phase_rms_A = std::sqrt(p.copper_W / (3 * b.motor.machine.R_ohm));
  p.phase_peak_A = sums.current_peak;
  const double moved = std::max({std::fabs(sums.supplied), std::fabs(sums.air_gap), sums.copper});
  if (moved > 0)
    p.energy_residual = (sums.supplied - sums.copper - sums.devices - sums.air_gap - sums.magnetic) / moved;
  p.simulated_s = T;
  return p;
}

/// At speed 0 the rotor is about to turn in the driven direction: dry friction is subtracted from the torque,
/// but at most the whole torque.
double friction_at(const plant::Shaft& shaft, double speed, double torque_Nm) {
  if (speed != 0) return friction_Nm(shaft, speed);
  return std::copysign(std::min(shaft.coulomb_Nm, std::fabs(torque_Nm)), torque_Nm);
}

void take_to_shaft(const Bench& b, OperatingPoint& p) {
  p.shaft_torque_Nm = p.torque_Nm - friction_at(b.motor.shaft, p.speed_rad_s, p.torque_Nm);
  p.friction_W = friction_Nm(b.motor.shaft, p.speed_rad_s) * p.speed_rad_s;
  p.shaft_W = p.shaft_torque_Nm * p.speed_rad_s;
  if (p.supplied_W > 0 && p.shaft_W > 0)
    p.efficiency = p.shaft_W / p.supplied_W;
  else if (p.supplied_W < 0 && p.shaft_W < 0)
    p.efficiency = p.supplied_W / p.shaft_W;
}

/// The currents in steady state one sector later. Sixty degrees are half a turn minus a third of a turn. For
/// every quantity x of a symmetric machine and bridge, therefore, x_a(theta + 60 deg) = -x_b(theta); in the
/// same way, -x_c replaces x_b, and -x_a replaces x_c.
PerLeg<double> one_sector_on(const PerLeg<double>& i, bool forward) {
  return forward ? PerLeg<double>{-i[1], -i[2], -i[0]} : PerLeg<double>{-i[2], -i[0], -i[1]};
}

double distance(const PerLeg<double>& x, const PerLeg<double>& y) {
  double squares = 0.0;
  for (int k = 0; k < 3; ++k) squares += (x[k] - y[k]) * (x[k] - y[k]);
  return std::sqrt(squares);
}

/// The sector map, applied by running the plant through one sector.
class SectorMap {
 public:
  SectorMap(const Bench& b, double speed) : system_(b, imposed_speed(), speed), forward_(speed > 0) {}

  /// Runs to the next sector start. Returns the distance between the currents and the currents one sector
  /// before.
  double apply(sim::Stop& stop, SumsRecorder* recorder = nullptr) {
    stop = system_.run_to_edge(system_.edges() + 1, recorder);
    const PerLeg<double> now = system_.plant().state().i;
    const double moved = distance(now, one_sector_on(start_, forward_));
    start_ = now;
    return moved;
  }
  const FullOn& system() const { return system_; }

 private:
  FullOn system_;
  PerLeg<double> start_{};
  bool forward_;
};

/// Time constants after which a run with chopping is averaged: exp(-20) = 2e-9 of the initial deviation
/// remains.
constexpr double forgotten = 20.0;

/// Upper limit of simulated sectors. The currents converge within 37 L/R, and no motor's L/R lasts fifty
/// thousand sectors.
constexpr std::int64_t most_sectors = 2'000'000;

base::Result<OperatingPoint> full_on(const Bench& b, double speed) {
  SectorMap map(b, speed);
  const double q = base::exp(-forgetting_rate(b) * sector_seconds(b, speed));
  const double noise = map.system().plant().constants().amp_noise;
  sim::Stop stop = sim::Stop::observer;
  map.apply(stop);  // from the start angle to the first edge
  double moved = 0.0;
  do moved = map.apply(stop);
  while (stop == sim::Stop::observer && moved > noise && map.system().edges() < most_sectors);
  const bool repeats = moved <= noise;
  SumsRecorder recorder;
  if (stop == sim::Stop::observer) moved = map.apply(stop, &recorder);
  if (stop != sim::Stop::observer) return ended_early(speed, stop);
  OperatingPoint p = point_of(b, speed, recorder.sums());
  p.orbit = Orbit::periodic;
  p.sectors = map.system().edges();
  p.residual_A = moved;
  p.precise = repeats;
  p.error_bound_A = (q * moved + noise) / (1 - q);  // rounding counts as another step of the size `noise`
  take_to_shaft(b, p);
  return p;
}

/// Mean of the quantity `of` over the batches, and half width of its confidence interval.
struct Interval {
  double mean = 0.0, half_width = 0.0;
};
template <class Of>
Interval interval(const std::vector<Sums>& parts, Of&& of) {
  constexpr double student_19 = 2.860935;  // 99.5 % quantile of Student's t with batches - 1 = 19
  static_assert(batches == 20);
  const auto n = static_cast<double>(parts.size());
  double sum = 0.0, squares = 0.0;
  for (const Sums& part : parts) sum += of(part) - of(parts[0]);
  const double mean = of(parts[0]) + sum / n;
  for (const Sums& part : parts) squares += (of(part) - mean) * (of(part) - mean);
  return {mean, student_19 * std::sqrt(squares / (n - 1) / n)};
}

plant::Shaft held() { return {.J_kg_m2 = 1.0, .locked = true}; }

/// Duration of one batch, s: at least 40 PWM periods and 4 time constants. Soft chopping repeats every 120
/// degrees, so that a batch lasts whole pairs of sectors. With a held rotor, it lasts whole PWM periods.
double batch_seconds(const Bench& b, double speed) {
  const double least = std::max(40 * b.pwm_period_s, 4 / forgetting_rate(b));
  const double unit = speed != 0 ? 2 * sector_seconds(b, speed) : b.pwm_period_s;
  return std::ceil(least / unit) * unit;
}

struct Gathered {
  std::vector<Sums> parts;
  bool precise = false;
  std::int64_t sectors = 0;
  sim::Stop stop = sim::Stop::end;
};

/// Largest half width of a precise interval, N m (operating_point.hpp).
double goal_Nm(const Bench& b) {
  return half_width_goal * std::fabs(b.duty) * b.motor.K_t_Nm_A * b.voltage_V / (2 * b.motor.machine.R_ohm);
}

/// Begin of batch n, s: the initial deviation has decayed. The golden ratio spreads the phase of the PWM
/// period evenly for any number of batches.
double begin_of(const Bench& b, int n) {
  constexpr double golden = 0.6180339887498949;
  const double phase = n * golden - std::floor(n * golden);
  return (std::ceil(forgotten / forgetting_rate(b) / b.pwm_period_s) + phase) * b.pwm_period_s;
}

/// Angle in sectors at which the rotor must start to be in the middle of a sector when the batch begins. All
/// batches begin at the same angle and last whole sectors; they differ only in the PWM's phase.
double start_of(const Bench& b, double speed, double begin_s) {
  const double turned = speed != 0 ? begin_s / sector_seconds(b, speed) : 0.0;
  const double start = speed > 0 ? 0.5 - turned : 0.5 + turned;
  return start - 6 * std::floor(start / 6);
}

Gathered gather(const Bench& b, double speed) {
  Gathered out;
  std::deque<OpenLoop> runs;  // a deque, because its elements keep their addresses: each rig refers to its
                              // run
  for (int n = 0; n < batches && out.stop == sim::Stop::end; ++n) {
    const double begin_s = begin_of(b, n);
    const plant::Shaft shaft = speed != 0 ? imposed_speed() : held();
    runs.emplace_back(b, plant_of(b, shaft, speed, start_of(b, speed, begin_s)));
    out.stop = runs.back().run_for(begin_s);
  }
  out.parts.resize(batches);
  double length = batch_seconds(b, speed);
  for (int doubled = 0; out.stop == sim::Stop::end; ++doubled) {
    for (std::size_t n = 0; n < batches && out.stop == sim::Stop::end; ++n) {
      SumsRecorder recorder;
      out.stop = runs[n].run_for(length, recorder);
      out.parts[n].add(recorder.sums());
    }
    const Interval torque = interval(out.parts, [](const Sums& s) { return s.torque / s.seconds; });
    out.precise = torque.half_width <= goal_Nm(b);
    if (out.precise || doubled == doublings) break;
    if (doubled > 0) length *= 2;
  }
  for (const OpenLoop& run : runs) out.sectors += run.sectors();
  return out;
}

base::Result<OperatingPoint> chopped(const Bench& b, double speed) {
  const Gathered g = gather(b, speed);
  if (g.stop != sim::Stop::end) return ended_early(speed, g.stop);
  Sums all;
  for (const Sums& part : g.parts) all.add(part);
  OperatingPoint p = point_of(b, speed, all);
  p.orbit = Orbit::quasi_periodic;
  p.sectors = g.sectors;
  p.precise = g.precise;
  p.half_width_Nm = interval(g.parts, [](const Sums& s) { return s.torque / s.seconds; }).half_width;
  p.half_width_A =
      interval(g.parts, [&](const Sums& s) { return s.supplied / s.seconds / b.voltage_V; }).half_width;
  if (speed == 0) {
    spread_over_angles(b.motor, all, p);
    p.locked = locked_rotor(b.motor, all);
  }
  take_to_shaft(b, p);
  return p;
}

/// The point at rest. At full duty the current of a held rotor is U divided by the loop's resistance.
OperatingPoint stall(const Bench& b) {
  const double R_s = b.motor.machine.R_ohm;
  const double i = b.duty * b.voltage_V / (2 * (R_s + b.devices.R_on_ohm));
  Sums sums;
  sums.seconds = 1.0;
  sums.motor = i;
  sums.winding = sums.motor_size = sums.current_peak = std::fabs(i);
  sums.motor_square = i * i;
  sums.motor_low = sums.motor_high = i;
  sums.copper = 2 * R_s * i * i;
  sums.devices = 2 * b.devices.R_on_ohm * i * i;
  sums.supplied = b.voltage_V * std::fabs(i);
  OperatingPoint p = point_of(b, 0.0, sums);
  spread_over_angles(b.motor, sums, p);
  p.locked = locked_rotor(b.motor, sums);
  take_to_shaft(b, p);
  return p;
}

}  // namespace

base::Result<OperatingPoint> operating_point(const Bench& b, double speed) {
  base::Problems problems = check(b);
  if (!(speed - speed == 0.0))
    problems.push_back({"speed", base::written(speed), "must be a finite number", "give the speed in rad/s"});
  if (!problems.empty()) return problems;
  if (told_to_stop(b)) return interrupted_work();
  const bool full = b.duty == 1 || b.duty == -1;
  if (full && speed == 0) return stall(b);
  return full ? full_on(b, speed) : chopped(b, speed);
}

}  // namespace sixstep::analysis

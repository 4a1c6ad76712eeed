// SPDX-License-Identifier: Apache-2.0
#include "sixstep/analysis/curve/no_load.hpp"

#include <algorithm>
#include <cmath>

#include "sixstep/analysis/curve/full_on.hpp"
#include "sixstep/analysis/curve/open_loop.hpp"
#include "sixstep/analysis/curve/sums_recorder.hpp"
#include "sixstep/base/written.hpp"

namespace sixstep::analysis {
namespace {

/// Shaft torque over speed, both positive in the direction in which the duty drives.
struct Sample {
  double speed = 0.0, torque = 0.0;
  OperatingPoint point;
};

class NoLoadSearch {
 public:
  explicit NoLoadSearch(const Bench& b) : bench_(b), direction_(b.duty < 0 ? -1.0 : 1.0) {}

  base::Problems problems;

  bool take(double speed, Sample& into) {
    base::Result<OperatingPoint> point = operating_point(bench_, direction_ * speed);
    if (!point) {
      problems = point.problems();
      return false;
    }
    into = {speed, direction_ * point->shaft_torque_Nm, *point};
    if (speed == 0)
      into.torque -= bench_.motor.shaft.coulomb_Nm;  // dry friction acts against the begin of
                                                     // the motion
    return true;
  }

 private:
  const Bench& bench_;
  double direction_;
};

/// Finds speeds below and above the crossing, from standstill up to seven times the ideal no-load speed at
/// full voltage.
bool bracket(NoLoadSearch& search, const Bench& b, Sample& low, Sample& high) {
  if (!search.take(0.0, low)) return false;
  if (!(low.torque > 0)) {
    search.problems = {{"duty", base::written(b.duty),
                        "gives less torque than the motor's friction, so the rotor does not turn",
                        "give a higher duty or voltage"}};
    return false;
  }
  constexpr int steps = 10;
  double speed = b.voltage_V / b.motor.K_t_Nm_A;
  for (int n = 0; n < steps; ++n, speed *= 1.25) {
    if (!search.take(speed, high)) return false;
    if (high.torque <= 0) return true;
    low = high;
  }
  search.problems = {{"speed", base::written(high.speed) + " rad/s",
                      "is more than seven times the ideal no-load speed, and the torque is still positive",
                      "correct torque constant and friction in the motor file"}};
  return false;
}

/// False position; the value of the retained end is halved (Illinois method). The search ends when the speed
/// changes by 1e-11 or less, or when zero lies within the torque's interval.
bool narrow(NoLoadSearch& search, Sample low, Sample high, Sample& found, double& slope) {
  constexpr int most = 100;
  double f_low = low.torque, f_high = high.torque;
  const Sample* moved = nullptr;  // the end that moved last
  found = high;
  for (int n = 0; n < most && found.torque != 0; ++n) {
    const double speed = (low.speed * f_high - high.speed * f_low) / (f_high - f_low);
    const double before = found.speed;
    if (!search.take(speed, found)) return false;
    slope = found.torque > 0 ? (high.torque - found.torque) / (high.speed - found.speed)
                             : (found.torque - low.torque) / (found.speed - low.speed);
    const bool sure = found.point.orbit == Orbit::quasi_periodic
                          ? std::fabs(found.torque) <= found.point.half_width_Nm
                          : std::fabs(found.speed - before) <= 1e-11 * found.speed;
    if (sure) return true;
    if (found.torque > 0) {
      if (moved == &low) f_high /= 2;
      low = found;
      f_low = found.torque;
      moved = &low;
    } else {
      if (moved == &high) f_low /= 2;
      high = found;
      f_high = found.torque;
      moved = &high;
    }
  }
  return true;
}

double angle_of(const plant::Plant<double>& p) {
  return (static_cast<double>(p.state().sector) * base::sector_rad + p.state().x) / p.constants().pole_pairs;
}

void note_means(const Bench& b, const Sums& sums, double turned_rad, double before_s, NoLoad& out) {
  out.free_speed_rad_s = turned_rad / sums.seconds;
  out.free_bus_current_A = sums.supplied / sums.seconds / b.voltage_V;
  out.free_winding_current_A = sums.winding / sums.seconds;
  out.free_s = before_s + sums.seconds;
}

/// Runs the free rotor for `settle_s`, then averages over `mean_s`.
void run_free(const Bench& b, OpenLoop& system, double settle_s, double mean_s, NoLoad& out) {
  system.run_for(settle_s);
  SumsRecorder recorder;
  const double from = angle_of(system.plant());
  system.run_for(mean_s, recorder);
  note_means(b, recorder.sums(), angle_of(system.plant()) - from, settle_s, out);
}

/// Runs the free rotor like the function above, but averages over a whole number of sectors, because the
/// rotor's swing in a part of a sector would change the means.
void run_free(const Bench& b, FullOn& system, double settle_s, double mean_s, NoLoad& out) {
  system.run_for(settle_s);
  const std::int64_t first = system.edges();
  system.run_to_edge(first + 1);
  const double settled_s = system.now().seconds(), from = angle_of(system.plant());
  SumsRecorder recorder;
  const double sectors = std::ceil(static_cast<double>(first) * mean_s / settle_s);
  system.run_to_edge(first + 1 + static_cast<std::int64_t>(sectors), &recorder);
  note_means(b, recorder.sums(), angle_of(system.plant()) - from, settled_s, out);
}

}  // namespace

base::Result<NoLoad> no_load(const Bench& b) {
  if (base::Problems problems = check(b); !problems.empty()) return problems;
  NoLoadSearch search(b);
  Sample low, high, found;
  double slope = 0.0;
  if (!bracket(search, b, low, high)) return search.problems;
  slope = (high.torque - low.torque) / (high.speed - low.speed);
  if (!narrow(search, low, high, found, slope)) return search.problems;
  NoLoad out;
  out.point = found.point;
  if (out.point.supplied_W > 0)
    out.point.efficiency = 0.0;  // the remaining shaft power is only a rounding
                                 // error
  out.slope_Nm_s = slope;
  out.half_width_rad_s = found.point.half_width_Nm / std::fabs(slope);
  out.time_constant_s = b.motor.shaft.J_kg_m2 / std::fabs(slope);
  const double time_constant = std::min(out.time_constant_s, longest_free_s / 22);
  out.settled = time_constant == out.time_constant_s;
  const plant::Plant<double> plant = plant_of(b, b.motor.shaft, found.point.speed_rad_s);
  if (found.point.orbit == Orbit::periodic) {
    FullOn system(b, b.motor.shaft, found.point.speed_rad_s);
    run_free(b, system, 20 * time_constant, 2 * time_constant, out);
  } else {
    OpenLoop system(b, plant);
    run_free(b, system, 20 * time_constant, 2 * time_constant, out);
  }
  if (told_to_stop(b)) return interrupted_work();
  return out;
}

}  // namespace sixstep::analysis

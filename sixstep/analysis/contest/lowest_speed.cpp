// SPDX-License-Identifier: Apache-2.0
#include "sixstep/analysis/contest/lowest_speed.hpp"

#include <algorithm>

#include "sixstep/base/angle.hpp"

namespace sixstep::analysis {
namespace {

using study::MetricKind;
using study::Signal;

constexpr std::size_t stages = 6, asked_of_each = 3;
constexpr double mean_part = 0.05, swing_part = 0.5;

void ask(study::Scenario& s, MetricKind metric, double from_s, double to_s, std::optional<double> least,
         std::optional<double> most) {
  study::Measure m;
  m.metric = metric;
  m.signal = Signal::speed;
  m.from_s = from_s;
  m.to_s = to_s;
  s.require.push_back({m, least, most});
}

}  // namespace

std::vector<double> slow_speeds(const Course& course) {
  std::vector<double> speeds;
  for (double w = course.slow_rad_s; speeds.size() < stages; w /= 2) speeds.push_back(w);
  return speeds;
}

study::Scenario slow_scenario(const study::Scenario& contestant, const ContestBench& bench) {
  study::Scenario s = contestant;
  const double settle_s = bench.design.spec.settle_s.value_or(10e-3);
  const double turn_rad = 2 * base::pi / bench.design.motor.machine.pole_pairs;
  s.title = "Lowest speed";
  s.load.times_s.clear();
  s.load.torques_Nm.clear();
  s.load.torque_Nm = bench.course.load_Nm;
  s.reference = {};
  s.reference.shape = study::Shape::steps;
  s.require.clear();
  s.compare.clear();
  double begin_s = 0.0;
  for (const double w : slow_speeds(bench.course)) {
    const double from_s = begin_s + 5 * settle_s + turn_rad / w;
    const double to_s = from_s + std::max(settle_s, 2 * turn_rad / w);
    s.reference.times_s.push_back(begin_s);
    s.reference.values.push_back(w);
    ask(s, MetricKind::mean, from_s, to_s, (1 - mean_part) * w, (1 + mean_part) * w);
    ask(s, MetricKind::minimum, from_s, to_s, (1 - swing_part) * w, {});
    ask(s, MetricKind::maximum, from_s, to_s, {}, (1 + swing_part) * w);
    begin_s = to_s;
  }
  s.duration_s = begin_s;
  return s;
}

std::optional<double> lowest_speed_rad_s(const Course& course, std::span<const study::Verdict> verdicts) {
  std::optional<double> lowest;
  const std::vector<double> speeds = slow_speeds(course);
  for (std::size_t k = 0; k < speeds.size() && asked_of_each * (k + 1) <= verdicts.size(); ++k) {
    const auto stage = verdicts.subspan(asked_of_each * k, asked_of_each);
    if (!std::all_of(stage.begin(), stage.end(), [](const study::Verdict& v) { return v.ok; })) break;
    lowest = speeds[k];
  }
  return lowest;
}

}  // namespace sixstep::analysis

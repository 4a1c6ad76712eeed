// SPDX-License-Identifier: Apache-2.0
#include "sixstep/analysis/bode/measured_loop.hpp"

#include <algorithm>
#include <cmath>

#include "sixstep/base/angle.hpp"
#include "sixstep/base/elementary.hpp"

namespace sixstep::analysis {
namespace {

/// Where a value falls through a level between two points, straight over the logarithm of the frequency.
struct Fall {
  const LoopPoint& before;
  const LoopPoint& after;
  double part = 0.0;  ///< of the way from one to the other

  template <class Value>
  double at(const Value& value) const {
    return value(before) + part * (value(after) - value(before));
  }
  double w_rad_s() const {
    return base::exp(at([](const LoopPoint& p) { return base::log(p.w_rad_s); }));
  }
};

enum class Which { first, last };

template <class Value>
std::optional<Fall> fall_through(const std::vector<LoopPoint>& points, double level, Which which,
                                 const Value& value) {
  std::optional<Fall> found;
  for (std::size_t n = 1; n < points.size(); ++n) {
    const double before = value(points[n - 1]), after = value(points[n]);
    if (!(before >= level && after < level)) continue;
    found.emplace(Fall{points[n - 1], points[n], (before - level) / (before - after)});
    if (which == Which::first) break;
  }
  return found;
}

double log_gain(const LoopPoint& p) { return base::log(p.gain); }
double phase(const LoopPoint& p) { return p.phase_rad; }

/// From the last point's phase by the shorter way; the first between -360 and 0 degrees, as a loop that integrates has it.
double unwrapped(double angle, const std::vector<LoopPoint>& before) {
  constexpr double turn = 2 * base::pi;
  if (before.empty()) return angle > 0.0 ? angle - turn : angle;
  const double last = before.back().phase_rad;
  return angle - turn * std::floor((angle - last) / turn + 0.5);
}

}  // namespace

std::vector<LoopPoint> loop_points(const Multisine& signal, const Answer& answer, double period_s) {
  std::vector<LoopPoint> points;
  for (std::size_t k = 0; k < answer.lines.size(); ++k) {
    const LineAnswer& line = answer.lines[k];
    const design::Complex T = line.gain, L = T / design::Complex{1.0 - T.re, -T.im};
    const double turns = static_cast<double>(signal.lines[k]) / static_cast<double>(signal.samples);
    points.push_back({.w_rad_s = 2 * base::pi * turns / period_s,
                      .closed = T,
                      .coherence = line.coherence,
                      .gain = L.size(),
                      .phase_rad = unwrapped(L.angle_rad(), points),
                      .scatter = line.scatter * (design::Complex{1.0, 0.0} + L).size()});
  }
  return points;
}

ReadMargins margins_of(const std::vector<LoopPoint>& points) {
  ReadMargins out;
  if (!answered(points)) return out;
  if (const auto crossing = fall_through(points, 0.0, Which::last, log_gain)) {
    out.crossover_rad_s = crossing->w_rad_s();
    out.phase_rad = base::pi + crossing->at(phase);
    out.delay_s = std::fmax(0.0, *out.phase_rad) / *out.crossover_rad_s;
  }
  if (const auto turned = fall_through(points, -base::pi, Which::first, phase))
    out.gain = base::exp(-turned->at(log_gain));
  constexpr double log_half_power = -0.34657359027997265471;
  if (const auto end = fall_through(points, log_half_power, Which::first,
                                    [](const LoopPoint& p) { return base::log(p.closed.size()); }))
    out.bandwidth_rad_s = end->w_rad_s();
  return out;
}

bool answered(const std::vector<LoopPoint>& points) {
  return std::any_of(points.begin(), points.end(),
                     [](const LoopPoint& p) { return p.coherence >= little_coherence && p.gain > 0.0; });
}

}  // namespace sixstep::analysis

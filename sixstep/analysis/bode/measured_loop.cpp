// SPDX-License-Identifier: Apache-2.0
#include "sixstep/analysis/bode/measured_loop.hpp"

#include <algorithm>
#include <cmath>

#include "sixstep/base/angle.hpp"
#include "sixstep/base/elementary.hpp"

namespace sixstep::analysis {
namespace {

/// The point, between two measured points, where a value falls below a level. The value is interpolated
/// linearly over the logarithm of the frequency.
struct Fall {
  const LoopPoint& before;
  const LoopPoint& after;
  double part = 0.0;  ///< fraction of the distance from `before` to `after`

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

}  // namespace

double next_to(double angle, double near) {
  return angle - base::turn_rad * std::ceil((angle - near) / base::turn_rad - 0.5);
}

std::vector<double> unwrapped(const std::vector<double>& angles) {
  std::vector<double> out;
  out.reserve(angles.size());
  for (const double angle : angles) out.push_back(next_to(angle, out.empty() ? -base::pi : out.back()));
  return out;
}

std::vector<LoopPoint> loop_points(const Multisine& signal, const Answer& answer, double period_s,
                                   const std::optional<design::SpeedLag>& lag) {
  std::vector<LoopPoint> points;
  std::vector<double> angles;
  for (std::size_t k = 0; k < answer.lines.size(); ++k) {
    const LineAnswer& line = answer.lines[k];
    const double w_rad_s = base::turn_rad * static_cast<double>(signal.lines[k]) /
                           static_cast<double>(signal.samples) / period_s;
    const design::Complex T = lag ? line.gain * lag->at(w_rad_s) : line.gain;
    const design::Complex L = T / design::Complex{1.0 - T.re, -T.im};
    angles.push_back(L.angle_rad());
    points.push_back({.w_rad_s = w_rad_s,
                      .closed = T,
                      .coherence = line.coherence,
                      .gain = L.size(),
                      .scatter = line.scatter * (design::Complex{1.0, 0.0} + L).size()});
  }
  const std::vector<double> phases = unwrapped(angles);
  for (std::size_t k = 0; k < points.size(); ++k) points[k].phase_rad = phases[k];
  return points;
}

ReadMargins margins_of(const std::vector<LoopPoint>& points) {
  ReadMargins out;
  if (!answered(points)) return out;
  if (const auto crossing = fall_through(points, 0.0, Which::last, log_gain)) {
    out.crossover_rad_s = crossing->w_rad_s();
    out.phase_rad = next_to(base::pi + crossing->at(phase), 0.0);
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

// SPDX-License-Identifier: Apache-2.0
// Shapes of the back-EMF as sums of a few functions of the angle theta. These are 1 and x (the angle since
// the sector's start) in each piece, and cos(m theta) and sin(m theta) for each order m. The product of the
// speed and a function is then the same for all phases. A delta is replaced by the star with the same
// terminal behaviour, e_a = (e_ab - e_ca)/3. The sum of the three branch EMFs drives the current around the
// delta, which is called the loop (model.md (9)).
#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include "sixstep/base/angle.hpp"
#include "sixstep/base/elementary.hpp"
#include "sixstep/plant/general/machine.hpp"

namespace sixstep::plant::general {

/// A "way" is a phase a, b, c, or the loop.
inline constexpr int way_count = 4;
template <class Real>
using PerWay = std::array<Real, way_count>;

/// A piece of a sector. In this piece the EMF per speed of each way is now + rise x, V s.
template <class Real>
struct Piece {
  Real from = 0, to = 0;
  PerWay<Real> now{}, rise{};
};

/// Coefficients of cos(m theta_e) and sin(m theta_e), with m = `order`, in the EMF per speed of each way and
/// in the cogging torque.
template <class Real>
struct Rotation {
  int order = 1;
  PerWay<Real> cos{}, sin{};              ///< V s
  Real cogging_cos = 0, cogging_sin = 0;  ///< N m
};

template <class Real>
struct ShapeTable {
  std::array<std::vector<Piece<Real>>, 6> sector;
  std::vector<Rotation<Real>> rotations;
  bool is_linear = false;  ///< true: `sector` contributes to the EMF, in addition to `rotations`

  /// Returns the rotation of this order, and adds it if there is none.
  Rotation<Real>& rotation(int order) {
    for (Rotation<Real>& r : rotations)
      if (r.order == order) return r;
    rotations.push_back({.order = order});
    return rotations.back();
  }
};

namespace detail {

/// cos and sin of a multiple of 30 degrees, exact where representable.
template <class Real>
void turn_by(int thirties, Real& cos, Real& sin) {
  constexpr Real half_root3 = Real(0.86602540378443864676372317075293618L);
  constexpr std::array<Real, 12> table{1,  half_root3,  Real(0.5),  0, -Real(0.5), -half_root3,
                                       -1, -half_root3, -Real(0.5), 0, Real(0.5),  half_root3};
  const auto at = [](int n) { return static_cast<std::size_t>((n % 12 + 12) % 12); };
  cos = table[at(thirties)];
  sin = table[at(thirties - 3)];
}

/// Corners of the trapezoid. The trapezoid is 1 within half the flat width around 60 degrees, and -1 around
/// 240 degrees.
inline std::vector<ShapePoint> corners(double flat_deg) {
  const double half = flat_deg / 2;
  std::vector<ShapePoint> points;
  for (const auto& [angle, value] :
       {std::pair{60 - half, 1.0}, {60 + half, 1.0}, {240 - half, -1.0}, {240 + half, -1.0}})
    points.push_back({angle < 0 ? angle + 360 : angle >= 360 ? angle - 360 : angle, value});
  std::sort(points.begin(), points.end(),
            [](const auto& a, const auto& b) { return a.angle_deg < b.angle_deg; });
  return points;
}

/// Value and slope (per degree) of the periodic polyline through the points, at one angle. At a point of the
/// polyline, the slope is the slope after this point.
struct Line {
  double value = 0.0, slope = 0.0;
};
inline Line line_at(const std::vector<ShapePoint>& points, double angle_deg) {
  double at = angle_deg - 360 * std::floor(angle_deg / 360);
  std::size_t next = 0;
  while (next < points.size() && points[next].angle_deg <= at) ++next;
  const ShapePoint& b = points[next % points.size()];
  const ShapePoint& a = points[(next + points.size() - 1) % points.size()];
  const double width = b.angle_deg - a.angle_deg + (b.angle_deg > a.angle_deg ? 0 : 360);
  double from = at - a.angle_deg;
  if (from < 0) from += 360;
  const double slope = (b.value - a.value) / width;
  return {a.value + slope * from, slope};
}

/// Values of the four ways from the values of phases or branches. Star: a, b, c, and 0. Delta: (ab - ca)/3
/// and its two cyclic counterparts, and the sum of the branches.
template <class Real>
PerWay<Real> as_ways(Winding winding, const PerLeg<Real>& branch) {
  if (winding == Winding::star) return {branch[0], branch[1], branch[2], Real(0)};
  const auto third = [](Real v) { return v * Real(1.0L / 3); };
  return {third(branch[0] - branch[2]), third(branch[1] - branch[0]), third(branch[2] - branch[1]),
          branch[0] + branch[1] + branch[2]};
}

/// Angle, degrees, by which the EMF of branch or phase k lags the shape f(theta): -30 for branch ab, whose
/// EMF is f(theta + 30), 0 for phase a.
inline int seen_later_deg(Winding winding, int k) { return 120 * k - (winding == Winding::delta ? 30 : 0); }

template <class Real>
void add_lines(const Machine& m, const std::vector<ShapePoint>& points, ShapeTable<Real>& table) {
  table.is_linear = true;
  for (int s = 0; s < 6; ++s) {
    std::vector<double> bounds{0, 60};  // degrees within the sector
    for (int k = 0; k < 3; ++k)
      for (const ShapePoint& p : points) {
        double at = p.angle_deg + seen_later_deg(m.winding, k) - 60 * s;
        at -= 360 * std::floor(at / 360);
        if (at > 0 && at < 60) bounds.push_back(at);
      }
    std::sort(bounds.begin(), bounds.end());
    bounds.erase(std::unique(bounds.begin(), bounds.end(), [](double a, double b) { return b - a < 1e-9; }),
                 bounds.end());
    bounds.back() = 60;
    for (std::size_t b = 0; b + 1 < bounds.size(); ++b) {
      const auto rad = [](double deg) {
        return deg == 60 ? Real(base::sector_rad) : Real(deg) / 60 * Real(base::sector_rad);
      };
      const double middle = (bounds[b] + bounds[b + 1]) / 2;
      PerLeg<Real> now{}, rise{};
      for (std::size_t k = 0; k < 3; ++k) {
        const Line line = line_at(points, 60 * s + middle - seen_later_deg(m.winding, static_cast<int>(k)));
        now[k] = Real(m.K_e_V_s[k]) * (Real(line.value) - Real(line.slope) * Real(middle));
        rise[k] = Real(m.K_e_V_s[k]) * Real(line.slope) * Real(60) / Real(base::sector_rad);
      }
      table.sector[static_cast<std::size_t>(s)].push_back({rad(bounds[b]), rad(bounds[b + 1]),
                                                           as_ways<Real>(m.winding, now),
                                                           as_ways<Real>(m.winding, rise)});
    }
  }
}

/// Adds a harmonic of order n and size c. With later = seen_later_deg(), it is c cos(n (theta - later - 60))
/// = c [cos(n theta) cos(n (later + 60)) + sin(n theta) sin(n (later + 60))].
template <class Real>
void add_harmonic(const Machine& m, const Harmonic& h, ShapeTable<Real>& table) {
  PerLeg<Real> cos{}, sin{};
  for (std::size_t k = 0; k < 3; ++k) {
    turn_by<Real>(h.order * ((seen_later_deg(m.winding, static_cast<int>(k)) + 60) / 30), cos[k], sin[k]);
    cos[k] *= Real(m.K_e_V_s[k]) * Real(h.size);
    sin[k] *= Real(m.K_e_V_s[k]) * Real(h.size);
  }
  Rotation<Real>& r = table.rotation(h.order);
  const PerWay<Real> c = as_ways<Real>(m.winding, cos), s = as_ways<Real>(m.winding, sin);
  for (int k = 0; k < way_count; ++k) {
    r.cos[k] += c[k];
    r.sin[k] += s[k];
  }
}

}  // namespace detail

template <class Real>
ShapeTable<Real> shape_table(const Machine& m) {
  ShapeTable<Real> table;
  if (m.shape.harmonics.empty())
    detail::add_lines(m, m.shape.table.empty() ? detail::corners(m.shape.flat_deg) : m.shape.table, table);
  for (const Harmonic& h : m.shape.harmonics) detail::add_harmonic(m, h, table);
  if (!table.is_linear)
    for (auto& pieces : table.sector) pieces.push_back({.to = Real(base::sector_rad)});
  for (const Cogging& c : m.cogging) {
    const base::SinCos phase = base::sin_cos(c.phase_rad);
    Rotation<Real>& r = table.rotation(static_cast<int>(std::floor(c.order / m.pole_pairs + 0.5)));
    r.cogging_cos += Real(c.torque_Nm) * Real(phase.sin);
    r.cogging_sin += Real(c.torque_Nm) * Real(phase.cos);
  }
  if (m.has_axes()) table.rotation(1);
  return table;
}

/// K_t/K_e (model.md 1): mean torque over a sector per ampere through the driven pair, for K_e = 1 and
/// without loop current. The sectors of a table may differ; the mean is then over all six sectors with their
/// driven pairs.
inline double sector_mean(const Machine& m) {
  const ShapeTable<double> table = shape_table<double>(m);
  constexpr std::array<std::pair<std::size_t, std::size_t>, 6> pairs{
      {{0, 1}, {0, 2}, {1, 2}, {1, 0}, {2, 0}, {2, 1}}};
  const std::size_t sectors = m.shape.table.empty() ? 1 : pairs.size();
  double sum = 0;
  for (std::size_t s = 0; s < sectors; ++s)
    for (const Piece<double>& p : table.sector[s]) {
      const auto [source, sink] = pairs[s];
      const double now = p.now[source] - p.now[sink], rise = p.rise[source] - p.rise[sink];
      sum += now * (p.to - p.from) + rise * (p.to * p.to - p.from * p.from) / 2;
    }
  sum /= static_cast<double>(sectors);
  for (const Rotation<double>& r : table.rotations) {
    const base::SinCos end = base::sin_cos(r.order * base::sector_rad);
    sum += ((r.cos[0] - r.cos[1]) * end.sin + (r.sin[0] - r.sin[1]) * (1 - end.cos)) / r.order;
  }
  return sum / base::sector_rad;
}

}  // namespace sixstep::plant::general

// SPDX-License-Identifier: Apache-2.0
#include "sixstep/analysis/identification/hall/hall_motion.hpp"

#include <algorithm>
#include <cmath>

#include "sixstep/analysis/identification/hall/motion_posterior.hpp"
#include "sixstep/base/angle.hpp"
#include "sixstep/base/elementary.hpp"

namespace sixstep::analysis {
namespace {

constexpr double sector_deg = 60.0;

/// Bound in standard deviations: a normally distributed value exceeds it once in two million.
constexpr double contradiction = 5.0;
/// Largest fraction of sightings that may be excluded.
constexpr double most_left_out = 0.05;

/// Excludes in each neighbourhood the sighting with the largest contradiction. No other sighting is excluded,
/// because an edge with a large error shifts its neighbours.
void leave_out(FoundMotion& m) {
  const auto size = m.points.size();
  std::vector<std::size_t> worst;
  for (std::size_t n = 0; n < size; ++n) {
    const double here = std::fabs(m.points[n].surprise);
    const double before = n > 0 ? std::fabs(m.points[n - 1].surprise) : 0.0;
    const double behind = n + 1 < size ? std::fabs(m.points[n + 1].surprise) : 0.0;
    if (here > contradiction && here >= before && here >= behind) worst.push_back(n);
  }
  if (static_cast<double>(m.left_out + worst.size()) > most_left_out * static_cast<double>(size)) return;
  for (const std::size_t n : worst) m.sightings[n].left_out = true;
  m.left_out += worst.size();
}

}  // namespace

Sighting sighting_of(const HallEdge& edge, const EdgeEffects& effects, double speed_deg_s) {
  Sighting s;
  s.t_s = edge.t_s;
  s.says_deg = sector_deg * static_cast<double>(edge.boundary);
  const double open_deg = speed_deg_s * edge.width_s;
  s.known_deg2 = open_deg * open_deg / 12.0;
  s.begins = edge.begins;
  const std::size_t at = repeating(edge.boundary, effects.own);
  if (!effects.relative || at + 1 < effects.own) s.effects[0] = {at, -1.0};
  if (effects.hysteresis) s.effects[1] = {effects.hysteresis_at(), -0.5 * edge.direction};
  if (effects.delay)
    s.effects[2] = {effects.delay_at(),
                    -edge.direction * (std::fabs(speed_deg_s) - effects.usual_speed_deg_s)};
  return s;
}

std::vector<double> rough_speeds(const std::vector<HallEdge>& edges) {
  std::vector<double> out(edges.size());
  for (std::size_t n = 0; n < edges.size(); ++n) {
    std::size_t from = n, to = n;
    while (n - from < 2 && from > 0 && !edges[from].begins) --from;
    while (to - n < 2 && to + 1 < edges.size() && !edges[to + 1].begins) ++to;
    const double T = edges[to].t_s - edges[from].t_s;
    if (T > 0.0) out[n] = sector_deg * static_cast<double>(edges[to].boundary - edges[from].boundary) / T;
  }
  return out;
}

bool find_motion(FoundMotion& m, int rounds, const std::function<void(FoundMotion&)>& refine) {
  for (int round = 0; round < rounds; ++round) {
    const std::optional<MotionNoise> noise =
        round == 0 ? likeliest_noise(m.sightings, m.effects.count(), m.sector_s, m.keep_going)
                   : likelier_noise(m.sightings, m.effects.count(), m.sector_s, m.noise, m.keep_going);
    if (!noise || (m.keep_going && !m.keep_going())) return false;
    std::optional<MotionFit> fit = fit_motion(m.sightings, m.effects.count(), *noise);
    if (!fit) return false;
    m.noise = *noise;
    m.fit = std::move(*fit);
    m.points = smooth_motion(m.sightings, m.fit, m.noise);
    if (round + 1 == rounds) break;
    leave_out(m);
    refine(m);
  }
  return true;
}

std::vector<double> in_step_deg(const FoundMotion& m) {
  struct Sum {
    double cos = 0.0, sin = 0.0, count = 0.0, open_deg = 0.0;
  };
  constexpr double turn = 2.0 * base::pi;
  std::vector<Sum> sums(m.effects.own);
  for (std::size_t n = 0; n < m.sightings.size(); ++n) {
    const Sighting& s = m.sightings[n];
    const double open_deg = std::sqrt(12.0 * s.known_deg2);
    if (!s.is_edge || s.left_out || !(open_deg > 0.0)) continue;
    double place_deg = s.says_deg;
    for (const Effect& e : s.effects)
      if (e.factor != 0.0) place_deg -= e.factor * m.fit.effects[e.index];
    const base::SinCos at = base::sin_cos(turn * (place_deg - m.points[n].angle_deg) / open_deg);
    // Jitter spreads the computed angle of an edge between two rows.
    const double steps = m.noise.jitter_deg / open_deg, left = base::exp(-0.5 * turn * turn * steps * steps);
    Sum& sum =
        sums[repeating(static_cast<std::int64_t>(std::floor(s.says_deg / sector_deg + 0.5)), m.effects.own)];
    sum.cos += left * at.cos;
    sum.sin += left * at.sin;
    sum.count += 1.0;
    sum.open_deg += open_deg;
  }
  std::vector<double> out;
  for (const Sum& s : sums) {
    constexpr double by_chance = 3.0, part_95 = 0.95 / 2.0;
    const double square = s.cos * s.cos + s.sin * s.sin;
    const bool together = s.count > 1.0 && square > by_chance * s.count;
    out.push_back(together ? part_95 * std::sqrt(square) / s.count * s.open_deg / s.count : 0.0);
  }
  return out;
}

std::optional<FoundMotion> motion_of_edges(const HallEdges& edges, std::size_t own,
                                           const KeepGoing& keep_going) {
  FoundMotion m;
  m.keep_going = keep_going;
  m.effects.own = own;
  m.effects.relative = true;
  m.sector_s = edges.sector_s;
  const std::vector<double> rough = rough_speeds(edges.edges);
  // A new stretch begins where the rotor reverses. Without voltages, two unknowns cannot be determined at a
  // reversal: the rotor's path beyond the last edge, and the hysteresis of the next edge.
  std::vector<HallEdge> one_way = edges.edges;
  for (std::size_t n = 1; n < one_way.size(); ++n)
    if (one_way[n].direction != one_way[n - 1].direction) one_way[n].begins = true;
  for (std::size_t n = 0; n < rough.size(); ++n)
    m.sightings.push_back(sighting_of(one_way[n], m.effects, rough[n]));
  const auto refine = [&](FoundMotion& f) {
    for (std::size_t n = 0; n < f.sightings.size(); ++n) {
      const bool left_out = f.sightings[n].left_out;
      f.sightings[n] = sighting_of(one_way[n], f.effects, f.points[n].speed_deg_s);
      f.sightings[n].left_out = left_out;
    }
  };
  if (!find_motion(m, 3, refine)) return {};
  return m;
}

}  // namespace sixstep::analysis

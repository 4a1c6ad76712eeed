// SPDX-License-Identifier: Apache-2.0
#include "sixstep/analysis/identification/hall/hall_offset.hpp"

#include <algorithm>
#include <cmath>

#include "sixstep/analysis/identification/hall/hall_alike.hpp"
#include "sixstep/base/elementary.hpp"
#include "sixstep/base/written.hpp"

namespace sixstep::analysis {
namespace {

std::string parity_columns(const HallLog& log) {
  if (log.voltages == RecordedVoltages::terminals) return "u_a, u_b, u_c";
  return log.u_V[2].empty() ? "u_ab, u_bc" : "u_ab, u_bc, u_ca";
}

/// The path with its angle scaled and shifted.
MotionPath turned(std::vector<MotionPoint> points, double factor, double off_deg) {
  for (MotionPoint& p : points) {
    p.angle_deg = factor * p.angle_deg + off_deg;
    p.speed_deg_s *= factor;
  }
  return MotionPath(std::move(points));
}

std::vector<HallEdge> in_place(const std::vector<HallEdge>& edges, const HallOffsetEstimate& place) {
  std::vector<HallEdge> out = edges;
  for (HallEdge& e : out) {
    e.boundary = (place.mirrored ? -e.boundary : e.boundary) + place.rotation;
    if (place.mirrored) e.direction = -e.direction;
  }
  return out;
}

constexpr std::size_t fewest_each_way = 6;

/// True if enough edges lie between the rotor's reversals to find the hysteresis. At an edge next to a
/// reversal, the edge's angle shows where the rotor reversed, not the width of the hysteresis, for two
/// reasons:
/// - The voltages are very low near a reversal, and the path bends most, more on one side of the reversal
///   than on the other. A spline of one stiffness does not fit such a path, and its error would count as
///   hysteresis.
/// - If jitter decides whether the rotor passes the edge, the passages are a biased sample.
///
/// These edges are therefore excluded in all rounds. If too few edges lie between the reversals, all edges
/// are used, and no hysteresis is computed.
bool tell_between_turns(const std::vector<HallEdge>& edges, std::size_t own) {
  std::vector<std::size_t> seen(own);
  std::size_t forward = 0, backward = 0;
  for (const HallEdge& e : edges) {
    if (e.at_turn) continue;
    ++(e.direction > 0 ? forward : backward);
    ++seen[repeating(e.boundary, own)];
  }
  return std::min(forward, backward) >= fewest_each_way && *std::min_element(seen.begin(), seen.end()) >= 2;
}

/// Edges and voltages in the order of their times. An edge that has been excluded stays excluded.
class Sightings {
 public:
  Sightings(const std::vector<VoltageVector>& vectors, std::vector<HallEdge> edges)
      : vectors_(vectors), edges_(std::move(edges)), left_out_(edges_.size()) {}

  /// Excludes the edges at reversals, and returns their number.
  std::size_t leave_out_turns() {
    for (std::size_t n = 0; n < edges_.size(); ++n) left_out_[n] = edges_[n].at_turn;
    return static_cast<std::size_t>(std::count(left_out_.begin(), left_out_.end(), true));
  }

  /// Computes the sightings of `m` with the present estimate of the path.
  void bring(FoundMotion& m, VoltageModel& model, const MotionPath& path) {
    if (const std::optional<VoltageModel> better = fit_voltages(vectors_, path)) model = *better;
    turned_into_place(model);
    const std::vector<Sighting> seen = voltage_sightings(vectors_, model, path);
    m.sightings.clear();
    std::size_t next = 0;
    for (std::size_t n = 0; n < edges_.size(); ++n) {
      while (next < seen.size() && seen[next].t_s < edges_[n].t_s && !edges_[n].begins)
        m.sightings.push_back(seen[next++]);
      const std::optional<MotionPath::At> at = path.at(edges_[n].t_s);
      m.sightings.push_back(sighting_of(edges_[n], m.effects, at ? at->speed_deg_s : 0.0));
      m.sightings.back().left_out = left_out_[n];
      // the edge lies outside all stretches
      while (next < seen.size() && seen[next].t_s < edges_[n].t_s) ++next;
    }
  }

  void note_left_out(const FoundMotion& m) {
    std::size_t n = 0;
    for (const Sighting& s : m.sightings)
      if (s.is_edge) left_out_[n++] = s.left_out;
  }

 private:
  const std::vector<VoltageVector>& vectors_;
  std::vector<HallEdge> edges_;
  std::vector<bool> left_out_;
};

double usual_speed(const std::vector<MotionPoint>& points) {
  double sum = 0.0;
  for (const MotionPoint& p : points) sum += std::fabs(p.speed_deg_s);
  return points.empty() ? 0.0 : sum / static_cast<double>(points.size());
}

bool speeds_differ(const std::vector<MotionPoint>& points, double usual) {
  constexpr double enough = 0.01;
  return std::any_of(points.begin(), points.end(), [&](const MotionPoint& p) {
    return std::fabs(std::fabs(p.speed_deg_s) - usual) > enough * usual;
  });
}

/// Finds in which of the two sequences the lines follow each other, with the probabilities of both. Returns a
/// Problem if neither fits.
base::Result<HallOffsetEstimate> which_way(const HallLog& log, const std::vector<VoltageVector>& vectors,
                                           const FoundMotion& by_edges, MotionPath& path) {
  // Differences of log likelihoods. With pure noise, ten unknowns reach 20 once in 60000 logs (half of chi
  // square), and 14 once in 500, but then they explain a very small part of the power. If the rotor explains
  // most of the power, 14 is enough, for example for a log of a rotor that turns forward and backward by a
  // few edges.
  constexpr double sure = 20.0, likely = 14.0;
  HallOffsetEstimate out;
  std::optional<VoltageModel> models[2];
  for (const int m : {0, 1})
    models[m] = fit_voltages(vectors, turned(by_edges.points, m == 0 ? 1.0 : -1.0, 0.0));
  if (!models[0] || !models[1])
    return base::Problem{.where = parity_columns(log),
                         .limit = "contain too few rows while the rotor turns",
                         .cure = "record voltages and Hall lines at the same time"};
  out.mirrored = models[1]->residual_V2 < models[0]->residual_V2;
  out.voltages = *models[out.mirrored ? 1 : 0];
  const double independent = static_cast<double>(out.voltages.rows) / out.voltages.memory_rows;
  const double least = std::max(out.voltages.residual_V2, 1e-300);
  const auto odds = [&](double against) {
    return independent * base::log(std::max(against, 1e-300) / least);
  };
  if (odds(out.voltages.still_V2) < (least < 0.5 * out.voltages.still_V2 ? likely : sure))
    return base::Problem{
        .where = parity_columns(log),
        .limit = "do not follow the Hall lines: the best fit does not explain " +
                 base::rounded(100.0 * least / std::max(out.voltages.still_V2, 1e-300), 3) +
                 " % of the voltages' power",
        .cure =
            "measure the three terminals of the same motor with the bridge off, and turn the motor faster"};
  out.mirrored_probability = 1.0 / (1.0 + base::exp(-odds(models[out.mirrored ? 0 : 1]->residual_V2)));
  const double off_deg = turned_into_place(out.voltages);
  out.rotation = static_cast<int>(std::floor((off_deg + 30.0) / 60.0));
  path = turned(by_edges.points, out.mirrored ? -1.0 : 1.0, off_deg);
  return out;
}

}  // namespace

base::Result<HallOffsetEstimate> place_by_voltages(const HallLog& log, const HallEdges& edges,
                                                   const FoundMotion& by_edges) {
  if (base::Problems wrong = check_alike(log, MotionPath(by_edges.points), edges.edges.size());
      !wrong.empty())
    return wrong;
  const std::vector<VoltageVector> vectors = vectors_of(log);
  MotionPath path({});
  base::Result<HallOffsetEstimate> place = which_way(log, vectors, by_edges, path);
  if (!place) return place;
  FoundMotion& m = place->motion;
  m.sector_s = by_edges.sector_s;
  m.keep_going = by_edges.keep_going;
  m.effects = {.own = by_edges.effects.own,
               .hysteresis = std::min(edges.forward, edges.backward) >= fewest_each_way};
  m.effects.usual_speed_deg_s = usual_speed(by_edges.points);
  m.effects.delay = speeds_differ(by_edges.points, m.effects.usual_speed_deg_s);
  Sightings sightings(vectors, in_place(edges.edges, *place));
  place->between_turns = tell_between_turns(edges.edges, m.effects.own);
  if (place->between_turns) place->at_turns = sightings.leave_out_turns();
  sightings.bring(m, place->voltages, path);
  constexpr int rounds = 4;
  const bool found = find_motion(m, rounds, [&](FoundMotion& now) {
    sightings.note_left_out(now);
    sightings.bring(now, place->voltages, MotionPath(now.points));
  });
  if (!found)
    return base::Problem{.where = parity_columns(log),
                         .limit = "do not determine the rotor's angle",
                         .cure = "turn the rotor by more turns during the recording"};
  return place;
}

}  // namespace sixstep::analysis

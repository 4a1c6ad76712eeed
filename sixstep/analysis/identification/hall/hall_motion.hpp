// SPDX-License-Identifier: Apache-2.0
// From edges to the rotor's way between them, and to where each edge stands.
#pragma once
#include <functional>
#include <optional>
#include <vector>

#include "sixstep/analysis/identification/hall/hall_edges.hpp"
#include "sixstep/analysis/identification/hall/smooth_motion.hpp"

namespace sixstep::analysis {

/// The unknowns that an edge's place is the sum of, and their indices: how far each of the edges that repeat
/// stands behind its place; half the hysteresis, in the direction of motion; the way during the delay.
struct EdgeEffects {
  std::size_t own = 6;  ///< edges before they repeat: 6, or 6 for each pole pair
  bool relative =
      false;  ///< nothing says where the rotor is: places are against the last one's, which is no unknown
  bool hysteresis = false;         ///< the log turns both ways
  bool delay = false;              ///< voltages say where the rotor is
  double usual_speed_deg_s = 0.0;  ///< at which the delay's way counts as the edges' own

  std::size_t hysteresis_at() const { return own - static_cast<std::size_t>(relative); }
  std::size_t delay_at() const { return hysteresis_at() + static_cast<std::size_t>(hysteresis); }
  std::size_t count() const { return delay_at() + static_cast<std::size_t>(delay); }
};

/// The edge as a sighting: what sampling leaves open of its time is a place left open, with the speed at hand.
Sighting sighting_of(const HallEdge& edge, const EdgeEffects& effects, double speed_deg_s);

/// A slope through the edges beside each: good enough for what sampling leaves open.
std::vector<double> rough_speeds(const std::vector<HallEdge>& edges);

struct FoundMotion {
  EdgeEffects effects;
  double sector_s = 0.0;
  std::vector<Sighting> sightings;
  MotionNoise noise;
  MotionFit fit;
  std::vector<MotionPoint> points;  ///< one per sighting
  std::size_t left_out = 0;
  KeepGoing keep_going{};
};

/// Finds noise, effects and way; leaves out what contradicts all others; lets `refine` bring the sightings up
/// to date; and again, `rounds` times. False where the sightings do not fix the effects.
bool find_motion(FoundMotion& motion, int rounds, const std::function<void(FoundMotion&)>& refine);

/// How far each of the edges that repeat may lie off because rows came in step with it: by the rotor's way, the edge always
/// fell into the same part of the time between two rows. Then sampling does not average out, and what it leaves open
/// stays open. Half widths, 95 %; 0 where chance would bring edges and rows together as often (Rayleigh's test, 5 %).
std::vector<double> in_step_deg(const FoundMotion& motion);

/// By the edges alone, `own` of them before they repeat.
std::optional<FoundMotion> motion_of_edges(const HallEdges& edges, std::size_t own,
                                           const KeepGoing& keep_going = {});

}  // namespace sixstep::analysis

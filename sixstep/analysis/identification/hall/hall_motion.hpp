// SPDX-License-Identifier: Apache-2.0
// Finds the rotor's path between the edges, and the angle of each edge.
#pragma once
#include <functional>
#include <optional>
#include <vector>

#include "sixstep/analysis/identification/hall/hall_edges.hpp"
#include "sixstep/analysis/identification/hall/smooth_motion.hpp"

namespace sixstep::analysis {

/// The unknowns whose sum is an edge's angle, and their indices:
/// - the angle by which each repeating edge lies behind its nominal angle;
/// - the hysteresis, half of it in the direction of motion;
/// - the path during the delay.
struct EdgeEffects {
  std::size_t own = 6;  ///< number of edges before they repeat: 6, or 6 for each pole pair
  /// The rotor's angle is unknown. Angles are then relative to the last edge, whose angle is no unknown.
  bool relative = false;
  bool hysteresis = false;         ///< true: the hysteresis is an unknown, because the log has both
                                   ///< directions
  bool delay = false;              ///< true: the delay is an unknown, because voltages show the rotor's angle
  double usual_speed_deg_s = 0.0;  ///< speed at which the delay's path counts as part of the edges' own
                                   ///< angles

  std::size_t hysteresis_at() const { return own - static_cast<std::size_t>(relative); }
  std::size_t delay_at() const { return hysteresis_at() + static_cast<std::size_t>(hysteresis); }
  std::size_t count() const { return delay_at() + static_cast<std::size_t>(delay); }
};

/// Converts an edge to a sighting. The time between two rows, within which the edge occurred, becomes an
/// uncertainty of the angle through the speed.
Sighting sighting_of(const HallEdge& edge, const EdgeEffects& effects, double speed_deg_s);

/// Speed at each edge in deg/s, as a slope through the adjacent edges: exact enough for the uncertainty of
/// sighting_of().
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

/// Finds noise, effects and path in `rounds` rounds. Between two rounds it excludes sightings that contradict
/// all others, and calls `refine` to update the sightings. Returns false if the sightings do not
/// determine the effects, or if keep_going ended the work.
bool find_motion(FoundMotion& motion, int rounds, const std::function<void(FoundMotion&)>& refine);

/// Possible error of each repeating edge if the rows were synchronous with it, in degrees: 95 % half width.
/// At the rotor's speed, the edge is then always in the same part of the time between two rows, and the
/// sampling error does not average out. The error is 0 if chance could also explain this coincidence of edges
/// and rows (Rayleigh's test, 5 %).
std::vector<double> in_step_deg(const FoundMotion& motion);

/// The motion from the edges only, with a repeating pattern of `own` edges. Empty if the edges do not
/// determine it.
std::optional<FoundMotion> motion_of_edges(const HallEdges& edges, std::size_t own,
                                           const KeepGoing& keep_going = {});

}  // namespace sixstep::analysis

// SPDX-License-Identifier: Apache-2.0
// Computes results as means over the unknown noise of a log. How freely the rotor moves and how much the
// edges jitter is unknown beforehand, and every result depends on both. Restricted likelihood estimates both.
// Each result is the mean over all values that the log allows, with their weights. An interval for only the
// likeliest values would be too narrow for a short log.
#pragma once
#include <optional>
#include <span>
#include <vector>

#include "sixstep/analysis/identification/distributions.hpp"
#include "sixstep/analysis/identification/hall/smooth_motion.hpp"

namespace sixstep::analysis {

/// The likeliest noise; empty if the sightings do not determine the effects. `sector_s`: typical time of a
/// sector, which only determines where the search begins. If no sighting is a voltage, the scale stays 1.
std::optional<MotionNoise> likeliest_noise(std::span<const Sighting> sightings, std::size_t effects,
                                           double sector_s, const KeepGoing& keep_going = {});
/// The likeliest noise. The search begins at `likely`, a noise that was likely for nearly the same sightings.
MotionNoise likelier_noise(std::span<const Sighting> sightings, std::size_t effects, double sector_s,
                           const MotionNoise& likely, const KeepGoing& keep_going = {});

class MotionPosterior {
 public:
  /// Computes the posterior from the possible noises around the likeliest one.
  static std::optional<MotionPosterior> of(std::span<const Sighting> sightings, std::size_t effects,
                                           double sector_s, const MotionNoise& likeliest,
                                           const KeepGoing& keep_going = {});

  /// Interval of the sum of the effects with these weights.
  Interval effects(std::span<const double> weights) const;
  /// Probability that this weighted sum lies in [low, high].
  double probability(std::span<const double> weights, double low, double high) const;
  /// The interval begins at 0 if a model without jitter explains the log equally well.
  Interval jitter_deg() const;

 private:
  struct Possible {
    double weight = 0.0;
    MotionNoise noise;
    MotionFit fit;
  };
  std::vector<Component> mixture(std::span<const double> weights) const;

  std::vector<Possible> all_;
  double jitter_step_ = 0.0;  // step of the jitter's logarithm
  bool maybe_none_ = false;
};

}  // namespace sixstep::analysis

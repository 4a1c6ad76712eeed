// SPDX-License-Identifier: Apache-2.0
// How freely the rotor moved and how much its edges jitter is not known beforehand, and what is read from a
// log depends on both. They are looked for by restricted likelihood, and every answer is the mean over all
// values that the log leaves open, each with its weight: an interval that took the likeliest ones for granted
// would be too narrow where the log is short.
#pragma once
#include <optional>
#include <span>
#include <vector>

#include "sixstep/analysis/identification/distributions.hpp"
#include "sixstep/analysis/identification/hall/smooth_motion.hpp"

namespace sixstep::analysis {

/// The likeliest noise; nothing where the sightings do not fix the effects. `sector_s` is the time that a
/// sector typically takes: it only says where to look. Where no sighting is a voltage, the scale stays 1.
std::optional<MotionNoise> likeliest_noise(std::span<const Sighting> sightings, std::size_t effects,
                                           double sector_s, const KeepGoing& keep_going = {});
/// From one that was likely for nearly the same sightings.
MotionNoise likelier_noise(std::span<const Sighting> sightings, std::size_t effects, double sector_s,
                           const MotionNoise& likely, const KeepGoing& keep_going = {});

class MotionPosterior {
 public:
  /// Around the likeliest noise.
  static std::optional<MotionPosterior> of(std::span<const Sighting> sightings, std::size_t effects,
                                           double sector_s, const MotionNoise& likeliest,
                                           const KeepGoing& keep_going = {});

  /// Of the sum of the effects with these weights.
  Interval effects(std::span<const double> weights) const;
  /// That it lies in [low, high].
  double probability(std::span<const double> weights, double low, double high) const;
  /// Down from 0 where none at all would explain the log as well.
  Interval jitter_deg() const;

 private:
  struct Possible {
    double weight = 0.0;
    MotionNoise noise;
    MotionFit fit;
  };
  std::vector<Component> mixture(std::span<const double> weights) const;

  std::vector<Possible> all_;
  double jitter_step_ = 0.0;  // of its logarithm
  bool maybe_none_ = false;
};

}  // namespace sixstep::analysis

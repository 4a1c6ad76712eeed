// SPDX-License-Identifier: Apache-2.0
// Estimates a rotor's angle over time from sightings of it, together with effects that are the same in all of them
// (places of the edges, hysteresis, delay). The rotor is turned by hand, by a drill or by its own drive.
//
// Model: the angle's second or its third derivative is white noise, the weakest assumption for a shaft that
// someone turns. The best estimate between sightings is then a spline whose stiffness follows from the data (G.
// Wahba, "Improper priors, spline smoothing and the problem of guarding against model errors in regression", J. R.
// Statist. Soc. B 40, 1978). Every sighting is
//
//   says = angle(t) + sum of its effects + noise
//
// Kalman's filter follows the angle. The effects and each stretch's unknown begin are further columns of the
// filter (P. de Jong, "The diffuse Kalman filter", Ann. Statist. 19, 1991): no prior is needed for them, and
// their likelihood is the restricted one.
#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "sixstep/analysis/identification/symmetric.hpp"

namespace sixstep::analysis {

/// Called repeatedly; false ends the work. Empty: the work is never ended early.
using KeepGoing = std::function<bool()>;

/// An unknown that is the same in every sighting, and the factor with which it enters this one.
struct Effect {
  std::size_t index = 0;
  double factor = 0.0;
};

struct Sighting {
  double t_s = 0.0;                 ///< rising within a stretch
  double says_deg = 0.0;            ///< electrical
  double known_deg2 = 0.0;          ///< variance by sampling
  bool is_edge = true;              ///< jitter adds to known_deg2; else, of a voltage, known_deg2 is scaled
  bool begins = false;              ///< the path since the last one is unknown: a stretch begins
  bool left_out = false;            ///< it contradicts all others
  std::array<Effect, 4> effects{};  ///< a factor of 0: no effect
};

/// Which derivative of the angle is white noise: second for torques that jump, third for torques that bend.
enum class Smoothness : std::uint8_t { second = 2, third = 3 };

struct MotionNoise {
  Smoothness smoothness = Smoothness::third;
  double intensity = 0.0;  ///< intensity of that derivative: deg^2/s^3, deg^2/s^5
  double jitter_deg = 0.0;
  double voltage_scale = 1.0;
};

/// Variance of the sighting. It is above 0 even without noise, because the filter divides by it.
inline double variance_of(const Sighting& s, const MotionNoise& noise) {
  constexpr double least_deg2 = 1e-8;
  const double known =
      s.is_edge ? s.known_deg2 + noise.jitter_deg * noise.jitter_deg : s.known_deg2 * noise.voltage_scale;
  return known + least_deg2;
}

struct MotionFit {
  std::vector<double> effects;
  Symmetric covariance;
  double log_likelihood = 0.0;
};

/// Empty where the sightings do not determine the effects.
std::optional<MotionFit> fit_motion(std::span<const Sighting> sightings, std::size_t effects,
                                    const MotionNoise& noise);

/// The rotor at a sighting, given all of them.
struct MotionPoint {
  double t_s = 0.0, angle_deg = 0.0, speed_deg_s = 0.0;
  /// Difference between the sighting and all others, over its deviation; 0 where it was left out.
  double surprise = 0.0;
  bool begins = false;
};
std::vector<MotionPoint> smooth_motion(std::span<const Sighting> sightings, const MotionFit& fit,
                                       const MotionNoise& noise);

/// The spline between the points.
class MotionPath {
 public:
  explicit MotionPath(std::vector<MotionPoint> points) : points_(std::move(points)) {}

  struct At {
    double angle_deg = 0.0, speed_deg_s = 0.0;
  };
  /// Empty before, after and between the stretches. Fast for times close to the last requested one.
  std::optional<At> at(double t_s) const;
  const std::vector<MotionPoint>& points() const { return points_; }

 private:
  std::vector<MotionPoint> points_;
  mutable std::size_t last_ = 0;
};

}  // namespace sixstep::analysis

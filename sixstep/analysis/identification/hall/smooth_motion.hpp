// SPDX-License-Identifier: Apache-2.0
// Estimates a rotor's angle over time from sightings of the rotor, together with effects that are the same in
// all sightings (angles of the edges, hysteresis, delay). A hand, a drill or the motor's own drive turns the
// rotor.
//
// Model: the angle's second or third derivative is white noise, the weakest assumption for a shaft that a
// person turns. The best estimate between sightings is then a spline whose stiffness follows from the data
// (G. Wahba, "Improper priors, spline smoothing and the problem of guarding against model errors in
// regression", J. R. Statist. Soc. B 40, 1978). Every sighting is
//
//   says = angle(t) + sum of its effects + noise
//
// Kalman's filter follows the angle. The effects and the unknown begin of each stretch are further columns of
// the filter (P. de Jong, "The diffuse Kalman filter", Ann. Statist. 19, 1991). These unknowns need no prior,
// and their likelihood is the restricted likelihood.
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

/// Called repeatedly; if it returns false, the work ends. Empty: the work always continues to its end.
using KeepGoing = std::function<bool()>;

/// An unknown that is the same in every sighting, and the factor with which it enters a sighting.
struct Effect {
  std::size_t index = 0;
  double factor = 0.0;
};

struct Sighting {
  double t_s = 0.0;         ///< rising within a stretch
  double says_deg = 0.0;    ///< measured angle, electrical degrees
  double known_deg2 = 0.0;  ///< variance by sampling
  bool is_edge = true;      ///< true: jitter adds to known_deg2; false: a voltage, whose known_deg2 is scaled
  bool begins = false;      ///< true: a stretch begins, because the path since the sighting before is unknown
  bool left_out = false;    ///< true: excluded, because the sighting contradicts all others
  std::array<Effect, 4> effects{};  ///< a factor of 0 means no effect
};

/// Derivative of the angle that is white noise: second for torques that jump, third for torques that change
/// continuously.
enum class Smoothness : std::uint8_t { second = 2, third = 3 };

struct MotionNoise {
  Smoothness smoothness = Smoothness::third;
  double intensity = 0.0;  ///< intensity of this derivative's noise: deg^2/s^3 (second), deg^2/s^5 (third)
  double jitter_deg = 0.0;
  double voltage_scale = 1.0;
};

/// Variance of the sighting, deg^2. It is above 0 even without noise, because the filter divides by it.
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

/// The fitted motion. Empty if the sightings do not determine the effects.
std::optional<MotionFit> fit_motion(std::span<const Sighting> sightings, std::size_t effects,
                                    const MotionNoise& noise);

/// The rotor's motion at the time of a sighting, estimated from all sightings.
struct MotionPoint {
  double t_s = 0.0, angle_deg = 0.0, speed_deg_s = 0.0;
  /// Difference between the sighting and the estimate from all other sightings, divided by its standard
  /// deviation; 0 if the sighting is excluded.
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
  /// Angle and speed at a time in s. Empty before, after and between the stretches. Fast for times close to
  /// the time of the last call.
  std::optional<At> at(double t_s) const;
  const std::vector<MotionPoint>& points() const { return points_; }

 private:
  std::vector<MotionPoint> points_;
  mutable std::size_t last_ = 0;
};

}  // namespace sixstep::analysis
